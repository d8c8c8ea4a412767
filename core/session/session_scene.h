// The scene of a session: its description, its packed arrays with the hierarchy, and whether closed surfaces surround
// the camera.
#pragma once

#include <memory>
#include <optional>

#include "core/scene/description.h"
#include "core/scene/enclosure.h"
#include "core/scene/scene_storage.h"

namespace pl {

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

    /// Records that paths of a camera at `eye` have escaped: tests once whether closed surfaces surround it. Sorting
    /// the edges of a million triangles takes half a second: skipped for large scenes unless `may_take_long`.
    void note_escape(glm::vec3 eye, bool may_take_long);
    /// Whether closed surfaces surround the camera, so that escaped paths were lost. False before any has escaped.
    bool is_closed() const { return is_closed_.value_or(false); }
    bool knows_whether_closed() const { return is_closed_.has_value(); }
    void remember_whether_closed(bool is_closed) { is_closed_ = is_closed; }
    /// Drops the result of the test, because the camera may have moved.
    void forget_whether_closed() { is_closed_.reset(); }

private:
    SessionScene() = default;

    std::shared_ptr<const SceneDescription> description_;
    std::shared_ptr<const HostScene> packed_;
    std::optional<Enclosure> enclosure_;  ///< once a path has escaped
    std::optional<bool> is_closed_;
    double build_seconds_ = 0.0;
};

}  // namespace pl
