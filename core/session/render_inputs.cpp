#include "core/session/render_inputs.h"

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/scene/pack_scene.h"
#include "core/scene/scene_hash.h"
#include "core/scene/validate.h"
#include "core/session/served_kernel.h"

namespace pl {

SessionScene::SessionScene(std::shared_ptr<const SceneDescription> description)
    : description_(std::move(description)) {
    const Stopwatch build;
    packed_ = std::make_shared<const HostScene>(pack_scene(*description_));
    build_seconds_ = build.seconds();
}

SessionScene SessionScene::with_material(std::uint32_t index, const MaterialDescription& material) const {
    if (index >= description_->materials.size())
        throw Error(ErrorKind::Usage, "material " + std::to_string(index) + " does not exist: expected 0 to " +
                                          std::to_string(description_->materials.size()) + " (exclusive)");
    validate_material(material, index, *description_);
    auto description = std::make_shared<SceneDescription>(*description_);
    description->materials[index] = material;
    SessionScene changed;
    changed.packed_ = std::make_shared<const HostScene>(repack_materials(*description, *packed_));
    changed.description_ = std::move(description);
    changed.build_seconds_ = build_seconds_;
    return changed;
}

const std::string& SessionScene::hash() const {
    if (hash_.empty()) hash_ = scene_hash(*description_);
    return hash_;
}

std::optional<bool> SessionScene::encloses(glm::vec3 eye, bool may_take_long) const {
    constexpr std::size_t kManyTriangles = 100'000;
    if (!enclosure_ && description_->triangles.size() > kManyTriangles && !may_take_long) return std::nullopt;
    if (!enclosure_) enclosure_.emplace(*description_);
    return enclosure_->contains(eye);
}

Camera RenderInputs::camera() const { return make_camera(settings.camera, settings.width, settings.height); }

RenderSettings RenderInputs::settings_for(FilmSlot slot) const {
    RenderSettings result = settings;
    result.method = slot.method;
    result.view = slot.view;
    return result;
}

FeatureSet RenderInputs::needed_features(FilmSlot slot) const {
    return pl::needed_features(*scene.packed(), settings_for(slot));
}

}  // namespace pl
