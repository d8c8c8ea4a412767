// BSDFs and textures of Mitsuba as the surfaces that the renderer knows.
#pragma once

#include "core/io/mitsuba/textures.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The material of a surface, and the parts that need the triangles that it is on.
struct MitsubaSurface {
    MaterialDescription material{};
    MitsubaObject image{};                  ///< the texture whose transformation is that of the surface; or nothing
    std::optional<MitsubaRelief> relief{};  ///< see add_mitsuba_relief()
    bool shows_vertex_colors = false;       ///< a color is that of the vertices of its shapes
};

/// The surface of a `bsdf` element, with its textures added to the scene. Adapters such as `twosided` are those of the surface
/// inside. [Mitsuba 3 and 0.6, plugins]
MitsubaSurface mitsuba_surface(const MitsubaFile& file, const MitsubaObject& bsdf, SceneDescription& scene);

/// The object that `object` stands for: the one with its id if it is a `ref`.
MitsubaObject mitsuba_target(const MitsubaFile& file, const MitsubaObject& object);

}  // namespace pl
