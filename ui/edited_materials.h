// The materials of the scene that is open, as a person has changed them since it was read.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

class EditedMaterials {
public:
    explicit EditedMaterials(std::shared_ptr<const SceneDescription> file) { open(std::move(file)); }

    /// Another scene: nothing is changed in it yet.
    void open(std::shared_ptr<const SceneDescription> file);

    const std::vector<MaterialDescription>& now() const { return now_; }
    /// As the file has it.
    const MaterialDescription& in_file(std::uint32_t index) const { return file_->materials[index]; }
    const SceneDescription& file() const { return *file_; }
    bool is_edited(std::uint32_t index) const { return now_[index] != in_file(index); }
    /// Of all that are not as in the file.
    std::vector<std::string> edited_names() const;

    /// Takes the place of a material. Throws Error(Input) as validate_material() does; nothing has changed then.
    void set(std::uint32_t index, const MaterialDescription& material);

private:
    std::shared_ptr<const SceneDescription> file_;
    std::vector<MaterialDescription> now_;
};

/// How lists call it: files may leave names out.
std::string shown_name(const MaterialDescription& material, std::uint32_t index);

/// May changing a material move radiance volumes? If not, the selected one stays what it is; see same_placement().
bool may_move_volumes(const MaterialDescription& before, const MaterialDescription& after);

}  // namespace pl
