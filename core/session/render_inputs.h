// What a session renders, and by which back end: the inputs of its fields and films, which only the session's edits change.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/scene/description.h"
#include "core/scene/enclosure.h"
#include "core/scene/scene_storage.h"
#include "core/session/backend.h"
#include "core/session/settings.h"

namespace pl {

/// A scene as it is described, and packed for kernels with its hierarchy.
class SessionScene {
public:
    /// Packs a valid scene and builds its hierarchy.
    explicit SessionScene(std::shared_ptr<const SceneDescription> description);

    /// The same scene with one other material; the hierarchy is shared. Throws Error(Usage) if there is no material of this
    /// number, Error(Input) if validate_material() refuses the new one.
    SessionScene with_material(std::uint32_t index, const MaterialDescription& material) const;

    const std::shared_ptr<const SceneDescription>& description() const { return description_; }
    const std::shared_ptr<const HostScene>& packed() const { return packed_; }
    double build_seconds() const { return build_seconds_; }
    /// scene_hash() of the description, which reads all of it: computed once, when first asked for.
    const std::string& hash() const;

    /// Whether closed surfaces surround a camera at `eye`. Sorting the edges of a million triangles takes half a second, once: empty
    /// for large scenes whose edges are not sorted yet, unless it `may_take_long`.
    std::optional<bool> encloses(glm::vec3 eye, bool may_take_long) const;

private:
    SessionScene() = default;

    std::shared_ptr<const SceneDescription> description_;
    std::shared_ptr<const HostScene> packed_;
    mutable std::optional<Enclosure> enclosure_;  ///< once it was asked for
    mutable std::string hash_;                    ///< once it was asked for
    double build_seconds_ = 0.0;
};

struct RenderInputs {
    std::shared_ptr<RenderBackend> backend;
    RenderSettings settings;
    SessionScene scene;

    std::uint32_t pixel_count() const { return static_cast<std::uint32_t>(settings.width * settings.height); }
    Camera camera() const;
    /// The settings of one film.
    RenderSettings settings_for(FilmSlot slot) const;
    FeatureSet needed_features(FilmSlot slot) const;
};

}  // namespace pl
