#include "ui/model/edited_materials.h"

#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/scene/validate.h"

namespace pl::ui {

void EditedMaterials::open(std::shared_ptr<const SceneDescription> file) {
    file_ = std::move(file);
    now_ = file_->materials;
}

void EditedMaterials::reopen(std::shared_ptr<const SceneDescription> file) {
    const std::vector<MaterialDescription> before = now_;
    std::vector<std::uint32_t> edited;
    for (std::uint32_t i = 0; i < now_.size(); ++i)
        if (is_edited(i)) edited.push_back(i);
    open(std::move(file));
    for (const std::uint32_t i : edited) {
        if (i >= now_.size() || now_[i].name != before[i].name) continue;
        try {
            set(i, before[i]);
        } catch (const Error&) {
            continue;  // a texture of the edited material is gone
        }
    }
}

std::vector<std::string> EditedMaterials::edited_names() const {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < now_.size(); ++i)
        if (is_edited(i)) names.push_back(shown_name(now_[i], i));
    return names;
}

std::vector<MaterialDescription> EditedMaterials::named() const {
    std::vector<MaterialDescription> named;
    std::set<std::string> names;
    for (const MaterialDescription& material : now_)
        if (!material.name.empty() && names.insert(material.name).second) named.push_back(material);
    return named;
}

bool EditedMaterials::are_edits_named() const {
    std::set<std::string> names;
    for (std::uint32_t i = 0; i < now_.size(); ++i) {
        const bool is_named = !now_[i].name.empty() && names.insert(now_[i].name).second;
        if (!is_named && is_edited(i)) return false;
    }
    return true;
}

void EditedMaterials::set(std::uint32_t index, const MaterialDescription& material) {
    validate_material(material, index, *file_);
    now_[index] = material;
}

std::string shown_name(const MaterialDescription& material, std::uint32_t index) {
    return material.name.empty() ? fmt::format("material {}", index) : material.name;
}

bool may_move_volumes(const MaterialDescription& before, const MaterialDescription& after) {
    const auto is_plain = [](const MaterialDescription& m) {
        return m.kind == SurfaceKind::Diffuse && !m.textures.any();
    };
    const glm::vec3 black{0.0f};
    return !is_plain(before) || !is_plain(after) || before.emission != after.emission ||
           before.two_sided_emission != after.two_sided_emission ||
           (before.albedo == black) != (after.albedo == black);
}

}  // namespace pl::ui
