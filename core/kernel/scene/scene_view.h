// SceneView: every array of the scene that a kernel may read. A plain handle; core/scene owns the memory.
#pragma once

#include "core/kernel/base/span.h"
#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/texture.h"
#include "core/kernel/shading/far_lights.h"
#include "core/kernel/shading/light_tree.h"
#include "core/kernel/shading/material.h"
#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// Corner indices into SceneView::positions, counter-clockwise seen from the front.
struct Triangle {
    std::uint32_t v0, v1, v2;
    std::uint32_t material;
};

/// Where rays that leave a triangle may start; core/scene/triangle_planes.h derives the bounds.
struct TrianglePlane {
    Vec3f normal;          ///< unit, on the front side
    float position_error;  ///< distance that a ray must start off the plane
    float edge_margin;     ///< barycentric weights below this are too close to an edge
};

/// Shading normals of a triangle's corners: indices into SceneView::normals.
struct TriangleNormals {
    std::uint32_t n0, n1, n2;
};

/// A triangle that emits, with the running sum of (area x luminance of the emission) up to and including it,
/// divided by the sum over all lights: the cumulative probability of choosing it.
struct Light {
    std::uint32_t primitive;
    float cumulative_probability;
};

struct SceneView {
    Span<const Vec3f> positions;
    Span<const Triangle> triangles;
    Span<const TrianglePlane> planes;              ///< [triangle]
    Span<const Vec3f> normals;                     ///< empty unless the scene has smooth normals
    Span<const TriangleNormals> triangle_normals;  ///< one per triangle, or empty
    Span<const Material> materials;
    Span<const SurfaceLobes> lobes;        ///< [material]; empty if all are diffuse
    Span<const float> directional_albedo;  ///< tables that they refer to
    Textures textures;
    Span<const Light> lights;  ///< by ascending primitive
    LightTree light_tree;      ///< over them; empty if they are few
    BvhView bvh;
    float light_power =
        0.0f;  ///< sum over lights of area x luminance of the emission, over the share of their samples
    Vec3f environment{0.0f};       ///< radiance of everything that no surface covers
    FarLights far_lights;          ///< added to it
    float far_probability = 0.0f;  ///< that a light sample is one of the far lights rather than of `lights`
};

}  // namespace pl
