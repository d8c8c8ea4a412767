#include "core/bench/score.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/hash.h"
#include "core/bench/reference_store.h"
#include "core/io/files.h"
#include "core/io/json_document.h"
#include "core/measure/flip.h"

namespace pl::bench {
namespace {

namespace fs = std::filesystem;

/// One entry of "pictures".
struct ScoredPicture {
    std::string pointer;  ///< in the file, for messages
    fs::path path;
    BenchCell cell;
    std::uint64_t seed = 1;
    std::uint32_t samples = 0;
    double seconds = 0.0;
};

/// What score.json says.
class ScoreFile {
public:
    explicit ScoreFile(const fs::path& folder)
        : folder_(folder), file_(read_text_file(folder / kScoreFile), folder / kScoreFile) {
        file_.object("", {"schema", "device", "references", "methods", "pictures"});
        file_.require_schema(kScoreSchema);
    }

    const JsonDocument& file() const { return file_; }
    std::string device() const { return file_.text("/device").value_or("unknown"); }

    /// By run, then by samples.
    std::vector<ScoredPicture> pictures() const {
        std::vector<ScoredPicture> pictures;
        for (std::size_t i = 0; i < file_.array_size("/pictures"); ++i)
            pictures.push_back(picture(fmt::format("/pictures/{}", i)));
        if (pictures.empty()) file_.fail("/pictures", "expected pictures, got none");
        std::ranges::stable_sort(pictures, {},
                                 [](const ScoredPicture& p) { return std::tie(p.cell, p.seed, p.samples); });
        return pictures;
    }

    /// The order in which they are listed, else the order in which pictures name them.
    std::vector<std::string> methods() const {
        std::vector<std::string> methods = file_.texts("/methods").value_or(std::vector<std::string>{});
        const bool is_listed = !methods.empty();
        for (std::size_t i = 0; i < file_.array_size("/pictures"); ++i) {
            const std::string pointer = fmt::format("/pictures/{}/method", i);
            const std::string method = file_.text(pointer).value_or("");
            if (std::ranges::find(methods, method) != methods.end()) continue;
            if (is_listed) file_.fail(pointer, fmt::format("expected one of \"methods\", got '{}'", method));
            methods.push_back(method);
        }
        return methods;
    }

    /// Of one picture both halves are the same: the reference's own noise then counts as error.
    Reference reference(const std::string& scene) const {
        const std::string pointer = "/references" + pointer_step(scene);
        const auto files = file_.texts(pointer);
        if (!files || files->empty() || files->size() > 2)
            file_.fail(pointer, fmt::format("expected the reference of '{}', a list of one or two files", scene));
        Reference reference{.name = scene, .content = {}, .halves = {}};
        for (std::size_t half = 0; half < 2; ++half) {
            reference.halves[half].image = read_linear(folder_ / (*files)[half < files->size() ? half : 0]);
            reference.halves[half].spp = 1;
        }
        const LinearImage& first = reference.halves[0].image;
        require_size(pointer, folder_ / files->back(), reference.halves[1].image, first);
        reference.content.width = first.width;
        return reference;
    }

    void require_size(const std::string& pointer, const fs::path& path, const LinearImage& image,
                      const LinearImage& reference) const {
        if (image.width != reference.width || image.height != reference.height)
            file_.fail(pointer,
                       fmt::format("{}: expected {}x{} pixels as its reference has, got {}x{}", path.string(),
                                   reference.width, reference.height, image.width, image.height));
    }

private:
    std::string required_text(const std::string& pointer) const {
        const auto text = file_.text(pointer);
        if (!text || text->empty() || text->find('/') != std::string::npos)
            file_.fail(pointer, fmt::format("expected a name without '/', got '{}'", text.value_or("none")));
        return *text;
    }

    std::int64_t whole(const std::string& pointer, std::int64_t least, std::int64_t most) const {
        const auto number = file_.integer(pointer);
        if (!number || *number < least || *number > most)
            file_.fail(pointer, fmt::format("expected a whole number from {} to {}, got {}", least, most,
                                            number ? std::to_string(*number) : "none"));
        return *number;
    }

    ScoredPicture picture(const std::string& pointer) const {
        file_.object(pointer, {"file", "scene", "method", "backend", "seed", "samples", "seconds"});
        const auto name = file_.text(pointer + "/file");
        if (!name) file_.fail(pointer, "expected \"file\", a picture, got none");
        if (!(file_.number(pointer + "/seconds").value_or(0.0f) > 0.0f))
            file_.fail(pointer, fmt::format("{}: expected \"seconds\" above 0", *name));
        return {.pointer = pointer,
                .path = folder_ / *name,
                .cell = {required_text(pointer + "/scene"), required_text(pointer + "/method"),
                         file_.has(pointer + "/backend") ? required_text(pointer + "/backend") : "cpu"},
                .seed = file_.has(pointer + "/seed")
                            ? static_cast<std::uint64_t>(whole(pointer + "/seed", 0, 1'000'000'000'000))
                            : 1,
                .samples = static_cast<std::uint32_t>(whole(pointer + "/samples", 1, 1'000'000'000)),
                .seconds = file_.root().at(Json::json_pointer(pointer + "/seconds")).get<double>()};
    }

    fs::path folder_;
    JsonDocument file_;
};

std::string hash_of(const LinearImage& image) {
    Fnv1a hash;
    for (const Vec3f& pixel : image.pixels)
        for (const float value : {pixel.x, pixel.y, pixel.z}) hash.add(value);
    return fmt::format("{:016x}", hash.value());
}

/// Whether the next picture is of another run, or there is none.
bool ends_run(const std::vector<ScoredPicture>& pictures, std::size_t i) {
    return i + 1 == pictures.size() || pictures[i + 1].cell != pictures[i].cell ||
           pictures[i + 1].seed != pictures[i].seed;
}

/// Measures pictures one by one, each reference once.
class Scorer {
public:
    Scorer(const BenchFolder& folder, const ScoreFile& file, int threads)
        : folder_(folder), file_(file), threads_(threads) {}

    /// Pictures by run, then by samples.
    std::vector<BenchRun> runs(const std::vector<ScoredPicture>& pictures) {
        first_seed_ = std::ranges::min(pictures, {}, &ScoredPicture::seed).seed;
        std::vector<BenchRun> runs;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            const ScoredPicture& picture = pictures[i];
            if (runs.empty() || runs.back().cell != picture.cell || runs.back().seed != picture.seed)
                runs.push_back({.cell = picture.cell, .seed = picture.seed, .device = file_.device(), .series = {}});
            std::vector<RunPoint>& points = runs.back().series.points;
            const LinearImage image = read(picture);
            RunPoint point = measured(picture, image);
            if (!points.empty() && !(points.back().spp < point.spp && points.back().clocks.render < picture.seconds))
                file_.file().fail(
                    picture.pointer,
                    fmt::format("{}: expected more than {} samples and {} s, as another picture of the run "
                                "has, got {} and {} s",
                                picture.path.string(), points.back().spp, points.back().clocks.render,
                                picture.samples, picture.seconds));
            points.push_back(std::move(point));
            if (ends_run(pictures, i))
                runs.back().flip =
                    pl::mean_of(flip_map(image.pixels, reference_of(picture.cell.scene).mean().pixels, image.width));
        }
        return runs;
    }

    /// Schema "pathlight.bench-plan/1", as far as pictures tell it.
    Json plan(const std::vector<ScoredPicture>& pictures, const std::vector<BenchRun>& runs) const {
        Json scenes = Json::array();
        for (const auto& [name, reference] : references_)
            scenes.push_back({{"name", name},
                              {"scene", name},
                              {"picture_hash", hash_of(reference.halves[0].image)},
                              {"settings", Json::object()}});
        Json backends = Json::object();
        for (const ScoredPicture& picture : pictures)
            backends[picture.cell.backend] = {{"device", file_.device()}, {"threads", 0}};
        std::map<BenchCell, int> seeds;
        for (const BenchRun& run : runs) ++seeds[run.cell];
        return {{"schema", kPlanSchema},
                {"version", PL_VERSION},
                {"scenes", scenes},
                {"methods", file_.methods()},
                {"backends", backends},
                {"first_seed", first_seed_},
                {"seeds", std::ranges::max_element(seeds, {}, [](const auto& cell) { return cell.second; })->second}};
    }

    Json references_json() const {
        Json json = Json::object();
        for (const auto& [name, reference] : references_) json[name] = {{"noise_relmse", reference.noise().relmse}};
        return json;
    }

    std::vector<std::string> warnings{};

private:
    const Reference& reference_of(const std::string& scene) {
        const auto known = references_.find(scene);
        if (known != references_.end()) return known->second;
        const Reference& reference = references_.emplace(scene, file_.reference(scene)).first->second;
        folder_.save_reference_picture(scene, reference.mean());
        return reference;
    }

    LinearImage read(const ScoredPicture& picture) {
        LinearImage image = read_linear(picture.path, nullptr, &warnings);
        file_.require_size(picture.pointer, picture.path, image, reference_of(picture.cell.scene).halves[0].image);
        return image;
    }

    RunPoint measured(const ScoredPicture& picture, const LinearImage& image) {
        const Reference& reference = reference_of(picture.cell.scene);
        RunPoint point{.spp = picture.samples,
                       .clocks = {.render = picture.seconds},
                       .metrics = measure_error(image.pixels, reference.pixels(), threads_),
                       .counters = {}};
        if (point.metrics.invalid > 0)
            warnings.push_back(fmt::format("{}: {} pixels are NaN or infinite and in no mean", picture.path.string(),
                                           point.metrics.invalid));
        if (picture.seed == first_seed_) folder_.save_picture(picture.cell, point, image);
        return point;
    }

    const BenchFolder& folder_;
    const ScoreFile& file_;
    int threads_;
    std::uint64_t first_seed_ = 1;
    std::map<std::string, Reference> references_;
};

}  // namespace

ScoredPictures score_pictures(const BenchFolder& folder, int threads) {
    const ScoreFile file(folder.path());
    const std::vector<ScoredPicture> pictures = file.pictures();
    const std::vector<std::string> methods = file.methods();
    make_folder(folder.path() / "pictures");
    Scorer scorer(folder, file, threads);
    ScoredPictures scored;
    scored.results.runs = scorer.runs(pictures);
    scored.results.plan = scorer.plan(pictures, scored.results.runs);
    scored.results.references = scorer.references_json();
    scored.results.summary = summarize(scored.results.runs, methods);
    scored.results.date = utc_date();
    scored.results.complete = true;
    scored.warnings = std::move(scorer.warnings);
    return scored;
}

}  // namespace pl::bench
