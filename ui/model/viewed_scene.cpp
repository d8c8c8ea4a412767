#include "ui/model/viewed_scene.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/scene/pack_scene.h"

namespace pl {

ViewedScene::ViewedScene(const ModelServices& services, CameraMotion& camera, Selection& selection,
                         std::shared_ptr<const SceneDescription> scene)
    : options_(services.options), messages_(services.messages), jobs_(services.jobs), link_(services.link),
      camera_(camera), selection_(selection), name_(options_.scene_name), materials_(std::move(scene)) {}

void ViewedScene::load(const std::string& name, bool keep_camera) {
    messages_.note(MessageLevel::Info, "loading " + name);
    jobs_.push([this, name, keep_camera]() -> JobThread::Report {
        auto scene = options_.load_scene(name);
        return [this, scene, name, keep_camera] { adopt(scene, name, keep_camera); };
    });
}

void ViewedScene::adopt(std::shared_ptr<const SceneDescription> scene, const std::string& name, bool keep_camera) {
    selection_.deselect();
    selection_.drop_material();
    materials_.open(scene);
    name_ = name;
    camera_.open(scene->camera, bounds_of(*scene).diagonal(), keep_camera);
    for (const std::string& warning : scene->warnings) messages_.say(MessageLevel::Warning, warning);
    messages_.say(MessageLevel::Info, fmt::format("opened {}: {} triangles", name, scene->triangles.size()));
    link_.worker().submit(EditScene{std::move(scene)});
    link_.worker().submit(EditCamera{camera_.camera()});
}

std::optional<std::uint32_t> ViewedScene::selected_material() const {
    const auto index = selection_.material();
    return index && *index < materials_.now().size() ? index : std::nullopt;
}

void ViewedScene::select_material(std::uint32_t index) {
    if (index < materials_.now().size()) selection_.select_material(index);
}

void ViewedScene::set_material(std::uint32_t index, const MaterialDescription& material) {
    if (index >= materials_.now().size()) return;
    const MaterialDescription before = materials_.now()[index];
    if (material == before) return;
    try {
        materials_.set(index, material);
    } catch (const Error& error) {
        messages_.say(MessageLevel::Error, error.what());
        return;
    }
    if (selection_.volume() != kNoVolume && may_move_volumes(before, material)) selection_.drop_volume();
    camera_.touch();
    link_.worker().submit(EditMaterial{index, material});
}

void ViewedScene::restore_material(std::uint32_t index) {
    if (index < materials_.now().size()) set_material(index, materials_.in_file(index));
}

void ViewedScene::restore_materials() {
    for (std::uint32_t i = 0; i < materials_.now().size(); ++i) restore_material(i);
}

}  // namespace pl
