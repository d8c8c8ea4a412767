// The part of ViewerModel that changes materials.
#include "core/base/error.h"
#include "ui/viewer_model.h"

namespace pl {

void ViewerModel::select_material(std::uint32_t index) {
    if (index < materials_.now().size()) selected_material_ = index;
}

void ViewerModel::set_material(std::uint32_t index, const MaterialDescription& material) {
    if (index >= materials_.now().size()) return;
    const MaterialDescription before = materials_.now()[index];
    if (material == before) return;
    try {
        materials_.set(index, material);
    } catch (const Error& error) {
        say(LogLevel::Error, error.what());
        return;
    }
    if (selected_volume_ != kNoVolume && may_move_volumes(before, material)) select(kNoVolume);
    touch_motion();
    worker_.submit(EditMaterial{index, material});
}

void ViewerModel::restore_material(std::uint32_t index) {
    if (index < materials_.now().size()) set_material(index, materials_.in_file(index));
}

void ViewerModel::restore_materials() {
    for (std::uint32_t i = 0; i < materials_.now().size(); ++i) restore_material(i);
}

/// The scene as it is rendered: with the materials that were changed.
OpenScene ViewerModel::open_scene() const { return {scene_name_, status_.scene}; }

}  // namespace pl
