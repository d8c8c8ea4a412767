// The scene in the window: its name, its loading, and its materials as edited since.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/model/camera_motion.h"
#include "ui/model/edited_materials.h"
#include "ui/model/selection.h"
#include "ui/model/services.h"

namespace pl {

class ViewedScene {
public:
    ViewedScene(const ModelServices& services, CameraMotion& camera, Selection& selection,
                std::shared_ptr<const SceneDescription> scene);

    /// Name: the argument of load_scene.
    const std::string& name() const { return name_; }
    /// The rendered scene, with the edited materials.
    OpenScene rendered() const { return {name_, link_.status().scene}; }

    /// Reads the files again on the helper thread; the camera and the old scene stay until then.
    void reload() { load(name_, true); }
    /// Another scene with its own camera. If it cannot be read, the old one stays.
    void open(const std::string& name) { load(name, false); }

    const EditedMaterials& materials() const { return materials_; }
    /// Material of the last picked surface, or the one chosen from the list.
    std::optional<std::uint32_t> selected_material() const;
    void select_material(std::uint32_t index);
    /// Refuses invalid values with a message; the old material stays.
    void set_material(std::uint32_t index, const MaterialDescription& material);
    void restore_material(std::uint32_t index);  ///< as in the file
    void restore_materials();

private:
    void load(const std::string& name, bool keep_camera);
    void adopt(std::shared_ptr<const SceneDescription> scene, const std::string& name, bool keep_camera);

    const ViewerOptions& options_;
    Messages& messages_;
    Jobs& jobs_;
    RenderLink& link_;
    CameraMotion& camera_;
    Selection& selection_;
    std::string name_;
    EditedMaterials materials_;
};

}  // namespace pl
