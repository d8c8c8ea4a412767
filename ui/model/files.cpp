#include "ui/model/files.h"

#include <fmt/format.h>

#include "core/io/scene_materials.h"

namespace pl::ui {

std::filesystem::path Files::save_materials() {
    const std::filesystem::path path = names_.next(scene_, "materials", {".json"}).string() + ".json";
    jobs_.push([this, path, materials = scene_.materials().named()]() -> JobThread::Report {
        write_material_file(path, materials);
        return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
    });
    return path;
}

}  // namespace pl::ui
