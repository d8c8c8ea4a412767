// SceneView: the arrays of the scene that kernels read. A non-owning view; core/scene/scene_storage.h owns the
// memory.
#pragma once

#include "core/kernel/base/span.h"
#include "core/kernel/geometry/bvh_view.h"
#include "core/kernel/scene/instances.h"
#include "core/kernel/scene/texture.h"
#include "core/kernel/shading/delta_lights.h"
#include "core/kernel/shading/far_lights.h"
#include "core/kernel/shading/light_tree.h"
#include "core/kernel/shading/material.h"
#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// Corner indices into SceneView::positions, counter-clockwise seen from the front. Aligned, so that a device reads it at once.
struct alignas(16) Triangle {
    std::uint32_t v0, v1, v2;
    std::uint32_t material;
};

/// Bounds on the origins of rays that start on a triangle; derived in triangle_plane.h.
struct alignas(16) TrianglePlane {
    Vec3f normal;          ///< unit, on the front side
    float position_error;  ///< distance to offset ray origins from the plane
    float edge_margin;     ///< smallest barycentric weight of a ray origin
    /// Complete 32 bytes, so that equal planes have equal bytes.
    std::uint32_t zero1 = 0, zero2 = 0, zero3 = 0;
};

/// Shading normals of a triangle's corners: indices into SceneView::normals.
struct TriangleNormals {
    std::uint32_t n0, n1, n2;
};

/// An emissive triangle and the cumulative probability of choosing it: the sum of (area x luminance of the emission)
/// over the lights up to and including it, divided by the sum over all lights.
struct Light {
    std::uint32_t primitive;
    float cumulative_probability;
};

struct SceneView {
    Span<const Vec3f> positions;
    Span<const Triangle> triangles;                ///< of the scene directly, then of meshes
    Span<const TrianglePlane> planes;              ///< [triangle], of the triangles in the scene directly
    Span<const Vec3f> normals;                     ///< unit or 0; empty unless the scene has smooth normals
    Span<const TriangleNormals> triangle_normals;  ///< [triangle], or empty
    Span<const Vec3f> vertex_colors;               ///< [position], each channel in [0, 1]; empty if all are white
    Span<const Material> materials;
    Span<const SurfaceLobes> lobes;               ///< [material]; empty if all are diffuse
    Span<const float> directional_albedo;         ///< tables that SurfaceLobes::table indexes
    Span<const MaterialAnisotropy> anisotropies;  ///< [material]; empty if all facets are isotropic
    Span<const Vec3f> absorption;  ///< [material], per length, of the inside of glass; empty if nothing absorbs
    Textures textures;
    Span<const MaterialOpacity> opacities;  ///< [material]; empty if all are opaque
    Span<const MaterialBlend> blends;       ///< [material]; empty if none blends
    Span<const Light> lights;               ///< sorted by primitive
    LightTree light_tree;                   ///< over `lights`; empty if they are few
    BvhView bvh;                            ///< of the triangles that are in the scene directly
    InstancesView instances;
    /// Sum of area x luminance of the emission, divided by the probability that a light sample chooses `lights`.
    float light_power = 0.0f;
    Vec3f environment{0.0f};       ///< constant radiance of escaped rays
    FarLights far_lights;          ///< added to `environment`
    float far_probability = 0.0f;  ///< probability that a light sample chooses `far_lights` instead of `lights`
    Span<const DeltaLight> delta_lights;
    float delta_probability = 0.0f;  ///< that it chooses `delta_lights`; a multiple of 2^-10

    /// Number of the triangles that are in the scene directly: primitives below it are these triangles, others are
    /// triangles of instances.
    PL_HD std::uint32_t direct_triangles() const { return planes.count; }
};

}  // namespace pl
