// Sensors of Mitsuba scenes as cameras.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

struct MitsubaView {
    CameraDescription camera;
    float width, height;  ///< of the picture, in pixels
};

/// The view of a `sensor` element of the type perspective or thinlens, through the crop of its film, in a scene that is moved to an
/// origin. Throws Error(Input) for a picture without pixels or of too many, a crop that leaves it, no direction, and angles out of
/// (0, 180) degrees.
MitsubaView mitsuba_view(const MitsubaObject& sensor, const glm::dvec3& origin);

/// Notes the planes of clipping behind which the sensor would see something of the scene: nothing is clipped.
void note_clipped(const MitsubaObject& sensor, const SceneDescription& scene);

}  // namespace pl
