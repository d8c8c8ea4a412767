// BSDFs and textures of Mitsuba as the surfaces that the renderer knows.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

struct MitsubaLook {
    MaterialDescription material;
    bool shows_vertex_colors = false;  ///< a color is that of the vertices of its shapes
};

/// The surface of a `bsdf` element, with its textures added to the scene. Adapters such as `twosided` are those of the surface
/// inside. [Mitsuba 3 and 0.6, plugins]
MitsubaLook mitsuba_surface(const MitsubaFile& file, const MitsubaObject& bsdf, SceneDescription& scene);

/// Absorption per length inside of glass: that of a `medium` element of the type homogeneous, which scatters nothing. Other media
/// are noted and absorb nothing. [Mitsuba 3 and 0.6, homogeneous]
glm::vec3 mitsuba_absorption(const MitsubaObject& medium);

/// The object that `object` stands for: the one with its id if it is a `ref`.
MitsubaObject mitsuba_target(const MitsubaFile& file, const MitsubaObject& object);

}  // namespace pl
