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
    /// The materials that `material` blends with. Each has the share of the materials behind it, as has `material`;
    /// BlendDescription::other is not set.
    std::vector<MaterialDescription> others{};
    MitsubaObject image{};                  ///< the texture whose transformation the surface has; or nothing
    std::optional<MitsubaRelief> relief{};  ///< see add_mitsuba_relief()
    bool shows_vertex_colors = false;       ///< a color comes from the vertices of its shapes
    bool is_inside_out = false;             ///< the surface belongs to the other side of its shapes
};

/// The surface of a `bsdf` element, with its textures added to the scene. An adapter such as `twosided` gives the
/// surface inside. `depth`: number of the blends that it is part of. [Mitsuba 3 and 0.6, plugins]
MitsubaSurface mitsuba_surface(const MitsubaObject& bsdf, SceneDescription& scene, int depth = 0);

/// Gives a surface the transformation of a further image, or of nothing. All images share the transformation of the
/// first image, with a note.
void share_mitsuba_uv(const MitsubaObject& image, MitsubaSurface& surface);

}  // namespace pl
