// A path of the camera through several cameras.
#pragma once

#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Passes through its cameras in their order, each after the same time. The eye moves on a uniform Catmull-Rom spline
/// [Catmull, Rom 1974, "A Class of Local Interpolating Splines"]; the view turns by angles about the up direction of the first
/// camera, so that a level horizon stays level, by the shorter way around. Angle of view and aperture are interpolated linearly,
/// the distances of target and focus by their logarithms.
class CameraPath {
public:
    static constexpr std::size_t kFewest = 2;  ///< cameras

    /// At least kFewest cameras, each with a target away from its eye. Throws Error(Usage).
    explicit CameraPath(std::vector<CameraDescription> cameras);

    std::size_t size() const { return cameras_.size(); }
    /// `position` in [0, size() - 1]; a whole number is the camera of this index, to the bit.
    CameraDescription at(double position) const;
    /// Frame `index` of `frames`, which are evenly spaced; the first and the last frame are the first and the last camera.
    /// frames >= 2.
    CameraDescription frame(int index, int frames) const;

private:
    /// A camera's direction of view, as angles in radians.
    struct Angles {
        float yaw = 0.0f;    ///< continuous along the path
        float pitch = 0.0f;  ///< in [-pi/2, pi/2]
    };
    CameraDescription between(std::size_t index, float share) const;
    glm::vec3 direction(Angles angles) const;

    std::vector<CameraDescription> cameras_;
    std::vector<Angles> angles_;
    glm::vec3 up_{0.0f};        ///< unit
    glm::vec3 ahead_{0.0f};     ///< unit, of yaw 0
    glm::vec3 sideways_{0.0f};  ///< unit, of yaw pi/2
};

}  // namespace pl
