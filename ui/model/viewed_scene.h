// The scene in the window: its name, its loading, its knobs, and its materials as edited since.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/description.h"
#include "ui/model/camera_motion.h"
#include "ui/model/file_watch.h"
#include "ui/model/render_link.h"
#include "ui/model/selection.h"

namespace pl::ui {

/// The scenes opened last, by name or file.
class RecentFiles {
public:
    static constexpr std::size_t kMost = 10;

    /// To the front; a name that is there already moves.
    void add(const std::string& name) {
        std::erase(names_, name);
        names_.insert(names_.begin(), name);
        if (names_.size() > kMost) names_.resize(kMost);
    }
    /// Newest first, without duplicates, kMost of them.
    const std::vector<std::string>& names() const { return names_; }
    /// As names() gave them in another session; those that break its rules are dropped.
    void set(const std::vector<std::string>& names) {
        names_.clear();
        for (auto name = names.rbegin(); name != names.rend(); ++name) add(*name);
    }

private:
    std::vector<std::string> names_;
};

// Loads scenes on the helper thread: one at a time, and of the requests made meanwhile only the newest.

/// Reasons for loading a scene, which decide about the parts of the window that stay.
enum class LoadReason {
    Open,    ///< another scene
    Reload,  ///< the files again: the camera stays
    Knobs,   ///< other values of knobs: camera and edited materials stay
    Change,  ///< a file has changed: camera, knobs and edited materials stay
};

struct LoadOrder {
    SceneRequest scene;
    LoadReason reason = LoadReason::Open;
    std::string changed{};  ///< the file, for LoadReason::Change
};

class SceneLoader {
public:
    /// Called on the window's thread. `scene` is null if it cannot be loaded; `failure` says why.
    using Finish = std::function<void(const LoadOrder& order, std::shared_ptr<const SceneDescription> scene,
                                      const std::string& failure)>;

    SceneLoader(const ModelServices& services, Finish finish)
        : options_(services.options), jobs_(services.jobs), finish_(std::move(finish)) {}

    /// Replaces an order that waits. One that is being loaded is finished first, and dropped for another scene.
    void load(LoadOrder order);
    /// The newest order that is not finished; null without one.
    const LoadOrder* newest() const;

private:
    void start(LoadOrder order);
    void end(std::shared_ptr<const SceneDescription> scene, const std::string& failure);

    const ViewerOptions& options_;
    Jobs& jobs_;
    Finish finish_;
    std::optional<LoadOrder> running_;
    std::optional<LoadOrder> waiting_;
};

/// The materials of the scene in the window, as edited since it was loaded.
class EditedMaterials {
public:
    explicit EditedMaterials(std::shared_ptr<const SceneDescription> file) { open(std::move(file)); }

    /// Another scene, with unedited materials.
    void open(std::shared_ptr<const SceneDescription> file);

    /// The same scene, loaded anew: edits stay where the material of this number still has its name and the edited
    /// values are valid.
    void reopen(std::shared_ptr<const SceneDescription> file);

    const std::vector<MaterialDescription>& now() const { return now_; }
    /// As in the file.
    const MaterialDescription& in_file(std::uint32_t index) const { return file_->materials[index]; }
    const std::shared_ptr<const SceneDescription>& file() const { return file_; }
    bool is_edited(std::uint32_t index) const { return now_[index] != in_file(index); }
    /// Names of all materials that differ from the file.
    std::vector<std::string> edited_names() const;
    /// All that a file can name: of several materials of one name the first, and none without a name.
    std::vector<MaterialDescription> named() const;
    /// Whether named() has all edits.
    bool are_edits_named() const;

    /// Replaces a material. Throws Error(Input) as validate_material() does; the old one stays then.
    void set(std::uint32_t index, const MaterialDescription& material);

private:
    std::shared_ptr<const SceneDescription> file_;
    std::vector<MaterialDescription> now_;
};

/// Its name in lists: files may omit names.
std::string shown_name(const MaterialDescription& material, std::uint32_t index);

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
