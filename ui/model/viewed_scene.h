// The scene in the window: its name, its loading, its knobs, and its materials as edited since.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/model/camera_motion.h"
#include "ui/model/edited_materials.h"
#include "ui/model/file_watch.h"
#include "ui/model/recent_files.h"
#include "ui/model/scene_loader.h"
#include "ui/model/selection.h"
#include "ui/model/services.h"

namespace pl::ui {

class ViewedScene {
public:
    ViewedScene(const ModelServices& services, CameraMotion& camera, Selection& selection,
                std::shared_ptr<const SceneDescription> scene);

    /// Once per frame of the window: loads the scene again after one of its files has changed. Camera, knobs and edited
    /// materials stay; if the files cannot be read, the old scene does.
    void update();

    /// As load_scene takes it.
    const std::string& name() const { return name_; }
    /// The name as it means the same in every working directory.
    std::string lasting_name() const;
    /// The name with the knobs of the loaded scene that are not at their defaults.
    SceneRequest shown() const { return {name_, turned(materials_.file()->knobs)}; }
    /// The rendered scene, with the edited materials.
    OpenScene rendered() const { return {name_, link_.status().scene}; }

    /// Reads the files again on the helper thread; camera and knobs stay. The old scene stays until then, and if they
    /// cannot be read.
    void reload();
    /// Another scene with its own camera, its knobs at their defaults. If it cannot be read, the old one stays.
    void open(const std::string& name);

    /// Whether another scene is being loaded.
    bool is_opening() const;

    /// The scenes opened so far, files by their absolute paths.
    const RecentFiles& recent() const { return recent_; }
    /// Those of sessions before; the scene that is open stays in front.
    void remember(const std::vector<std::string>& recent);

    /// The values are the wanted ones, which the picture follows.
    const std::vector<KnobDescription>& knobs() const { return knobs_; }
    /// Loads the scene again with this value; camera, settings and edited materials stay. A value that the loader
    /// refuses leaves the old one, with a message. Nothing while another scene is being opened.
    void set_knob(std::size_t index, float value);
    void reset_knobs();

    const EditedMaterials& materials() const { return materials_; }
    /// Material of the last picked surface, or the one chosen from the list.
    std::optional<std::uint32_t> selected_material() const;
    void select_material(std::uint32_t index);
    /// Refuses invalid values with a message; the old material stays.
    void set_material(std::uint32_t index, const MaterialDescription& material);
    void restore_material(std::uint32_t index);  ///< as in the file
    void restore_materials();

private:
    static KnobValues turned(const std::vector<KnobDescription>& knobs);
    void load(LoadOrder order);
    void load_knobs() { load({{name_, turned(knobs_)}, LoadReason::Knobs}); }
    void finish(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene, const std::string& failure);
    void adopt(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene);
    void adopt_again(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene);

    Messages& messages_;
    RenderLink& link_;
    CameraMotion& camera_;
    Selection& selection_;
    std::string name_;
    EditedMaterials materials_;
    std::vector<KnobDescription> knobs_;
    RecentFiles recent_;
    SceneLoader loader_;
    FileWatch watch_;
};

}  // namespace pl::ui
