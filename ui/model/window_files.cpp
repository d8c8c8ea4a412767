#include "ui/model/window_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/io/field_file.h"
#include "core/io/picture_file.h"

namespace pl::ui {
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

void save_window_pixels(const std::filesystem::path& path, const ScreenPixels& pixels) {
    write_png8(path, {.width = pixels.width, .height = pixels.height, .rgb = pixels.rgb});
}

std::shared_ptr<LearnedField> load_window_field(const std::filesystem::path& path, const SceneDescription& scene) {
    const auto field = std::make_shared<LearnedField>(read_field(path));
    try {
        require_learned_in(scene, *field);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
    }
    return field;
}

}  // namespace pl::ui
