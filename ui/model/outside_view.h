// Whether the camera has left the room: it then sees surfaces that no light reaches, a black picture.
#pragma once

#include <memory>

#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Whether nearly all walks that begin at the camera and are scattered at the surfaces escape, in a scene without light from far away:
/// as they do from the outer side of a closed room.
bool looks_outside(const HostScene& scene, const CameraDescription& camera, int width, int height);

class OutsideView {
public:
    /// Once per frame of the window: looks again when the scene or the camera may be another.
    void update(const std::shared_ptr<const PublishedFrame>& frame);
    bool is_outside() const { return is_outside_; }

private:
    std::shared_ptr<const HostScene> scene_;
    std::uint64_t generation_ = 0;  ///< of the newest edit that was looked at
    bool is_outside_ = false;
};

}  // namespace pl::ui
