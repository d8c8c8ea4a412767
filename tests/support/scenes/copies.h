// Scenes with instances beside the same scenes with copies.
#pragma once

#include <algorithm>
#include <limits>

#include "core/io/load_scene.h"
#include "core/scene/instances.h"
#include "tests/support/catch.hpp"

namespace pl::test {

/// Keeps every instance.
inline const LoadSettings kKeepInstances{.most_copied_triangles = 0};

/// A scene with copies in the place of its instances, which have to be valid.
inline SceneDescription expanded(SceneDescription scene) {
    CHECK(complaints_about_instances(scene).empty());
    const std::uint64_t shown = shown_triangles(scene);
    expand_instances(scene);
    CHECK(scene.triangles.size() == shown);
    return scene;
}

/// Checks that two scenes without instances have the same triangles in the same order: materials, texture coordinates and colors
/// exactly, corners up to the roundings of a transformation in floats, normals within 1e-6.
inline void check_same_triangles(const SceneDescription& a, const SceneDescription& b) {
    REQUIRE(a.triangles.size() == b.triangles.size());
    REQUIRE(a.vertex_colors.empty() == b.vertex_colors.empty());
    float reach = 0.0f;
    for (const glm::vec3& p : b.positions) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const float rounding = 8.0f * reach * std::numeric_limits<float>::epsilon();
    for (std::size_t i = 0; i < a.triangles.size(); ++i) {
        const TriangleDescription& s = a.triangles[i];
        const TriangleDescription& t = b.triangles[i];
        INFO("triangle " << i);
        REQUIRE(s.material == t.material);
        REQUIRE(s.has_uvs() == t.has_uvs());
        for (int k = 0; k < 3; ++k) {
            REQUIRE(glm::distance(a.positions[s.vertex[k]], b.positions[t.vertex[k]]) <= rounding);
            const bool has_normal = t.normal[k] != TriangleDescription::kNoNormal;
            REQUIRE((s.normal[k] != TriangleDescription::kNoNormal) == has_normal);
            if (has_normal) REQUIRE(glm::distance(a.normals[s.normal[k]], b.normals[t.normal[k]]) <= 1e-6f);
            if (t.has_uvs()) REQUIRE(a.uvs[s.uv[k]] == b.uvs[t.uv[k]]);
            if (!b.vertex_colors.empty()) REQUIRE(a.vertex_colors[s.vertex[k]] == b.vertex_colors[t.vertex[k]]);
        }
    }
}

}  // namespace pl::test
