#include "core/bench/reference_store.h"

#include <algorithm>
#include <charconv>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/measure/picture_identity.h"
#include "core/scene/scene_hash.h"

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

PictureContent content_of(const SceneDescription& scene, const RenderSettings& settings) {
    return {.picture_hash = picture_hash(scene, settings),
            .scene_hash = scene_hash(scene),
            .width = settings.width,
            .height = settings.height,
            .max_depth = settings.max_depth};
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

}  // namespace pl::bench
