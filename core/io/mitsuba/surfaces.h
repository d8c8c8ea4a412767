// BSDFs and textures of Mitsuba as the surfaces that the renderer knows.
#pragma once

#include <optional>
#include <vector>

#include "core/io/mitsuba/textures.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The material of a surface, and the parts that need the triangles that it is on.
struct MitsubaSurface {
    MaterialDescription material{};
    /// Those that it blends with: each has the share of those behind it, as has `material`; BlendDescription::other is not set.
    std::vector<MaterialDescription> others{};
    MitsubaObject image{};                  ///< the texture whose transformation is that of the surface; or nothing
    std::optional<MitsubaRelief> relief{};  ///< see add_mitsuba_relief()
    bool shows_vertex_colors = false;       ///< a color is that of the vertices of its shapes
    bool is_inside_out = false;             ///< it is that of the other side of its shapes
};

/// The surface of a `bsdf` element, with its textures added to the scene. Adapters such as `twosided` are those of the surface
/// inside. `depth`: number of the blends that it is part of. [Mitsuba 3 and 0.6, plugins]
MitsubaSurface mitsuba_surface(const MitsubaObject& bsdf, SceneDescription& scene, int depth = 0);

/// Gives a surface the transformation of a further image, or of nothing. All images share that of the first one, with a note.
void share_mitsuba_uv(const MitsubaObject& image, MitsubaSurface& surface);

}  // namespace pl
