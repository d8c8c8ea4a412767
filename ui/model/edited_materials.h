// The materials of the scene in the window, as edited since it was loaded.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl::ui {

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

/// Whether the change may move radiance volumes; the number of the selected one is then invalid. See
/// same_placement().
bool may_move_volumes(const MaterialDescription& before, const MaterialDescription& after);

}  // namespace pl::ui
