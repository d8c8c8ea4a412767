#include "core/bench/reference_store.h"

#include <algorithm>
#include <charconv>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "core/base/hash.h"
#include "core/base/printable.h"
#include "core/base/timer.h"
#include "core/io/camera_file.h"
#include "core/measure/picture_identity.h"

namespace pl::bench {
namespace {

namespace fs = std::filesystem;

/// The files of a folder whose names have this ending, sorted.
std::vector<fs::path> files_ending(const fs::path& folder, std::string_view ending) {
    std::vector<fs::path> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().filename().string().ends_with(ending)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

/// The whole text of a metadata entry as a number of at least 0.
template <class Number>
Number number_in(const fs::path& path, const ImageMetadata& metadata, const char* key) {
    const std::string text = text_of(metadata, key);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || !(number >= Number{}))
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected a {}number of at least 0 as '{}', got '{}'", path.string(),
                                std::is_integral_v<Number> ? "whole " : "", key, text));
    return number;
}

}  // namespace

PictureContent content_of(const std::string& scene_hash, const RenderSettings& settings) {
    return {.picture_hash = picture_hash(scene_hash, settings),
            .scene_hash = scene_hash,
            .width = settings.width,
            .height = settings.height,
            .max_depth = settings.max_depth};
}

LinearImage Reference::mean() const {
    const auto& [first, second] = halves;
    return {.width = first.image.width,
            .height = first.image.height,
            .pixels = weighted_mean(first.image.pixels, first.spp, second.image.pixels, second.spp)};
}

Noise Reference::noise() const {
    return has_samples() ? estimate_noise({halves[0].image.pixels, halves[1].image.pixels}, content.width) : Noise{};
}

fs::path ReferenceStore::half_path(const std::string& name, std::size_t half) const {
    return folder_ / fmt::format("{}-{}.exr", name, half + 1);
}

ReferenceHalf ReferenceStore::load_half(const fs::path& path, const PictureContent& content) const {
    ImageMetadata metadata;
    ReferenceHalf half{.image = read_exr(path, &metadata)};
    if (text_of(metadata, kPictureHashKey) != content.picture_hash || half.image.width != content.width ||
        half.image.height != content.height)
        throw Error(ErrorKind::Input,
                    fmt::format("{}: shows another scene, camera, size, light or depth than its name says (expected "
                                "picture hash {}, got '{}'): delete it",
                                path.string(), content.picture_hash, text_of(metadata, kPictureHashKey)));
    half.spp = number_in<std::uint32_t>(path, metadata, "spp");
    half.parts = number_in<std::uint32_t>(path, metadata, "parts");
    half.seconds = number_in<double>(path, metadata, "seconds");
    return half;
}

std::optional<Reference> ReferenceStore::find(const PictureContent& content) const {
    std::optional<Reference> found;
    for (std::size_t half = 0; half < 2; ++half)
        for (const fs::path& path :
             files_ending(folder_, fmt::format("-{}-{}.exr", content.picture_hash, half + 1))) {
            const std::string file = path.stem().string();
            if (!found) found = Reference{.name = file.substr(0, file.size() - 2), .content = content, .halves = {}};
            found->halves[half] = load_half(path, content);
        }
    return found;
}

std::string ReferenceStore::other_contents(const PictureContent& content) const {
    std::string text;
    for (const fs::path& path : files_ending(folder_, ".json")) {
        const Json manifest = read_json_file(path, kReferenceSchema);
        std::string differs;
        const auto compare = [&](const char* what, bool same) {
            if (!same) differs += fmt::format("{}{}", differs.empty() ? "" : ", ", what);
        };
        read_members(path, [&] {
            compare("geometry, materials or lights", manifest.at("scene_hash") == content.scene_hash);
            compare("size", manifest.at("width") == content.width && manifest.at("height") == content.height);
            compare("depth", manifest.at("max_depth") == content.max_depth);
            return 0;
        });
        text += fmt::format("; {} differs in {}", path.filename().string(), differs.empty() ? "camera" : differs);
    }
    return text.empty() ? "; the folder holds no reference" : text;
}

Reference ReferenceStore::require(const PictureContent& content) const {
    if (auto found = find(content); found && found->has_samples()) return *std::move(found);
    throw Error(ErrorKind::Input, fmt::format("{}: expected the reference of this picture (hash {}), there is none{}",
                                              folder_.string(), content.picture_hash, other_contents(content)));
}

void ReferenceStore::save_half(const Reference& reference, std::size_t half) const {
    const ReferenceHalf& saved = reference.halves[half];
    write_exr(half_path(reference.name, half), saved.image,
              {{"Software", "pathlight " PL_VERSION},
               {kPictureHashKey, reference.content.picture_hash},
               {"scene_hash", reference.content.scene_hash},
               {kReferenceHalfKey, std::to_string(half + 1)},
               {"spp", std::to_string(saved.spp)},
               {"parts", std::to_string(saved.parts)},
               {"seconds", print_real(saved.seconds)}});
}

fs::path ReferenceStore::save_manifest(const Reference& reference, const Json& about) const {
    const PictureContent& content = reference.content;
    Json manifest{
        {"schema", kReferenceSchema},       {"version", PL_VERSION},  {kPictureHashKey, content.picture_hash},
        {"scene_hash", content.scene_hash}, {"width", content.width}, {"height", content.height},
        {"max_depth", content.max_depth}};
    manifest.update(about);
    Json halves = Json::array();
    for (std::size_t half = 0; half < 2; ++half) {
        const ReferenceHalf& saved = reference.halves[half];
        halves.push_back({{"file", half_path(reference.name, half).filename().string()},
                          {"spp", saved.spp},
                          {"parts", saved.parts},
                          {"seconds", saved.seconds}});
    }
    manifest["halves"] = halves;
    const Noise noise = reference.noise();
    manifest["noise"] = {{"mse", noise.mse}, {"relmse", noise.relmse}, {"epsilon", kEpsilon}};
    const fs::path path = folder_ / (reference.name + ".json");
    write_json_file(path, manifest);
    return path;
}

namespace {

/// Length of a stretch of passes, which a crash may lose; the first ones are shorter, so that both halves soon have samples.
constexpr double kPartSeconds = 10.0;
constexpr double kFirstPartSeconds = 1.0;

/// Far from the small seeds that users choose, and different for every stretch of passes.
std::uint64_t part_seed(std::uint64_t seed, std::size_t half, std::uint32_t part) {
    Fnv1a hash;
    hash.add(seed);
    hash.add(std::uint64_t{half});
    hash.add(std::uint64_t{part});
    return hash.value();
}

class ReferenceMaker {
public:
    ReferenceMaker(Session& session, const ReferencePlan& plan, const ReferenceStore& store)
        : session_(session), plan_(plan), store_(store), seed_(session.settings().seed) {
        const PictureContent content = content_of(session.scene_hash(), session.settings());
        if (auto found = store.find(content)) {
            reference_ = *std::move(found);
        } else {
            reference_.name = fmt::format("{}-{}", session.scene().source.stem().string(), content.picture_hash);
            reference_.content = content;
        }
    }

    ReferenceOutcome run() {
        make_folder(store_.folder());
        while (!is_done() && !may_stop()) {
            const std::size_t half = reference_.halves[0].spp <= reference_.halves[1].spp ? 0 : 1;
            render_part(half);
            store_.save_half(reference_, half);
            store_.save_manifest(reference_, about());
        }
        const bool interrupted = !is_done();
        std::filesystem::path manifest = store_.save_manifest(reference_, about());
        return {std::move(reference_), std::move(manifest), interrupted};
    }

private:
    bool has_time() const { return !plan_.seconds || watch_.seconds() < *plan_.seconds; }

    std::uint32_t spp() const { return std::min(reference_.halves[0].spp, reference_.halves[1].spp); }
    bool is_done() const { return spp() > 0 && (spp() >= plan_.spp || !has_time()); }

    bool is_stopped() const { return plan_.stop != nullptr && *plan_.stop; }
    bool may_stop() const { return is_stopped() && (spp() > 0 || !plan_.in_both_halves); }

    double part_seconds() const {
        const double part = std::clamp(watch_.seconds(), kFirstPartSeconds, kPartSeconds);
        return plan_.seconds ? std::min(part, 0.25 * *plan_.seconds) : part;
    }

    /// One stretch of passes into a half. Passes are always finished, so that all pixels have the same samples.
    void render_part(std::size_t index) {
        ReferenceHalf& half = reference_.halves[index];
        session_.apply(EditSeed{part_seed(seed_, index, half.parts)});
        const FilmSlot slot = slot_of(session_.settings());
        const std::uint32_t wanted = plan_.spp - half.spp;
        const Stopwatch watch;
        do {
            session_.advance(slot);
            show(half.spp + session_.passes(slot), index);
        } while (session_.passes(slot) == 0 ||
                 (session_.passes(slot) < wanted && !is_stopped() && watch.seconds() < part_seconds()));
        add(half, session_.snapshot(slot), watch.seconds());
    }

    static void add(ReferenceHalf& half, const Snapshot& part, double seconds) {
        half.image.width = part.width;
        half.image.height = part.height;
        half.image.pixels =
            half.spp == 0 ? part.pixels : weighted_mean(half.image.pixels, half.spp, part.pixels, part.passes);
        half.spp += part.passes;
        half.seconds += seconds;
        ++half.parts;
    }

    void show(std::uint32_t half_spp, std::size_t index) const {
        if (!plan_.show) return;
        const double both = static_cast<double>(half_spp) + reference_.halves[1 - index].spp;
        double share = 0.5 * both / plan_.spp;
        if (plan_.seconds) share = std::max(share, watch_.seconds() / *plan_.seconds);
        plan_.show(
            {.activity = "reference",
             .share = std::min(share, 1.0),
             .spp = half_spp,
             .detail = fmt::format("half {}, {} spp, {}", index + 1, half_spp, duration_text(watch_.seconds()))});
    }

    Json about() const {
        const RenderSettings& settings = session_.settings();
        return {{"scene", plan_.scene},
                {"camera", camera_json(settings.camera)},
                {"method", info_of(settings.method).name},
                {"nee", settings.next_event},
                {"seed", seed_},
                {"complete", is_done()}};
    }

    Session& session_;
    const ReferencePlan& plan_;
    const ReferenceStore& store_;
    Stopwatch watch_;
    std::uint64_t seed_;
    Reference reference_;
};

}  // namespace

ReferenceOutcome make_reference(Session& session, const ReferencePlan& plan, const ReferenceStore& store) {
    return ReferenceMaker(session, plan, store).run();
}

}  // namespace pl::bench
