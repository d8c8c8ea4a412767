#include "ui/model/file_names.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/io/field_file.h"
#include "core/io/picture_file.h"
#include "core/scene/scene_hash.h"

namespace pl::ui {

std::filesystem::path NumberedNames::next(const std::filesystem::path& dir, const std::string& stem,
                                          std::initializer_list<const char*> suffixes) {
    while (true) {
        const std::string name = fmt::format("{}-{:04}", stem, ++last_);
        const bool taken = std::any_of(suffixes.begin(), suffixes.end(), [&](const char* suffix) {
            std::error_code ignored;
            return std::filesystem::exists(dir / (name + suffix), ignored);
        });
        if (!taken) return dir / name;
    }
}

std::string file_name_part(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
        result += safe ? c : '-';
    }
    return result.empty() ? "picture" : result;
}

namespace {

ImageMetadata metadata_of(const Snapshot& snapshot, const ViewerPicture& picture, const std::string& command) {
    ImageMetadata metadata{{"Software", "pathlight " PL_VERSION},
                           {"scene", picture.scene.name},
                           {"method", std::string(info_of(snapshot.slot.method).name)},
                           {"view", std::string(info_of(snapshot.slot.view).name)},
                           {"backend", picture.backend},
                           {"spp", std::to_string(snapshot.passes)},
                           {"command", command}};
    if (!picture.edited_materials.empty())
        metadata.emplace_back("edited materials", fmt::format("{}", fmt::join(picture.edited_materials, ", ")));
    return metadata;
}

}  // namespace

void save_window_picture(const std::filesystem::path& path, const Snapshot& snapshot, const ViewerPicture& picture,
                         const std::string& command) {
    save_picture(path, snapshot, picture.display, metadata_of(snapshot, picture, command));
}

void save_window_pixels(const std::filesystem::path& path, const ByteImage& pixels) {
    write_png8(path, {.width = pixels.width, .height = pixels.height, .rgb = pixels.rgb});
}

std::shared_ptr<LearnedField> load_window_field(const std::filesystem::path& path, const SceneDescription& scene) {
    const auto field = std::make_shared<LearnedField>(read_field(path));
    try {
        require_learned_in(scene_hash(scene), *field);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
    }
    return field;
}

}  // namespace pl::ui
