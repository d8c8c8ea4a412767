// Small scenes for tests, built as descriptions: boxes, blocks, spheres, and their transformations.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "core/kernel/base/frame.h"
#include "core/kernel/base/rng.h"
#include "core/scene/pack_scene.h"
#include "tests/support/numbers.h"

namespace pl::test {

/// Uniform numbers for building inputs: replayable, and independent of the standard library.
class Uniforms {
public:
    explicit Uniforms(std::uint64_t seed) : seed_(seed) {}

    /// In [0, 1), 24 bits.
    float next() { return to_unit_float(bits()); }
    float between(float low, float high) { return low + (high - low) * next(); }
    std::uint32_t bits() {
        if (position_ == 4) {
            block_ = philox4x32({{counter_++, 0, 0, 0}}, static_cast<std::uint32_t>(seed_),
                                static_cast<std::uint32_t>(seed_ >> 32));
            position_ = 0;
        }
        return block_.v[position_++];
    }
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>((std::uint64_t{bits()} * count) >> 32);
    }
    Vec2f square() {
        const float x = next();
        return {x, next()};
    }
    Vec3f cube(float low, float high) {
        const float x = between(low, high);
        const float y = between(low, high);
        return {x, y, between(low, high)};
    }
    /// Uniform on the sphere, unit to rounding.
    Vec3f direction() {
        for (;;) {
            const Vec3f v = cube(-1.0f, 1.0f);
            const float length2 = glm::dot(v, v);
            if (length2 > 1e-4f && length2 <= 1.0f) return v * (1.0f / std::sqrt(length2));
        }
    }

private:
    std::uint64_t seed_;
    std::uint32_t counter_ = 0;
    int position_ = 4;
    Philox block_{};
};

inline MaterialDescription with_albedo(MaterialDescription material, float albedo) {
    material.albedo = glm::vec3{albedo};
    return material;
}

/// Gray, not emitting.
inline MaterialDescription gray(float albedo = 0.5f) {
    MaterialDescription material;
    material.name = "gray";
    return with_albedo(material, albedo);
}

/// A scene, and its name in messages.
struct NamedScene {
    std::string name;
    HostScene scene;
};

/// A scene of gray triangles.
inline HostScene gray_scene(const std::function<void(SceneDescription&)>& build) {
    SceneDescription description;
    description.materials.push_back(gray());
    build(description);
    return pack_scene(description);
}

inline std::uint32_t add_vertex(SceneDescription& scene, Vec3f position) {
    scene.positions.push_back(position);
    return static_cast<std::uint32_t>(scene.positions.size() - 1);
}

inline void add_triangle(SceneDescription& scene, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                         std::uint32_t material = 0) {
    TriangleDescription triangle;
    triangle.vertex = {a, b, c};
    triangle.material = material;
    scene.triangles.push_back(triangle);
}

inline void add_triangle(SceneDescription& scene, Vec3f a, Vec3f b, Vec3f c, std::uint32_t material = 0) {
    const std::uint32_t first = add_vertex(scene, a);
    add_vertex(scene, b);
    add_vertex(scene, c);
    add_triangle(scene, first, first + 1, first + 2, material);
}

/// Counter-clockwise seen from the front.
inline void add_quad(SceneDescription& scene, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                     std::uint32_t material = 0) {
    add_triangle(scene, a, b, c, material);
    add_triangle(scene, a, c, d, material);
}

/// A box with shared vertices; its fronts look outwards, or inwards like the walls of a room.
inline void add_box(SceneDescription& scene, Vec3f low, Vec3f high, bool inwards, std::uint32_t material = 0) {
    std::uint32_t v[8];
    for (int i = 0; i < 8; ++i)
        v[i] = add_vertex(
            scene, {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
    constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& f : kFaces) {
        if (inwards)
            add_quad(scene, v[f[3]], v[f[2]], v[f[1]], v[f[0]], material);
        else
            add_quad(scene, v[f[0]], v[f[1]], v[f[2]], v[f[3]], material);
    }
}

/// Sphere of rings x segments facets whose radii vary between `low` and `high`; closed, vertices shared. Fronts look
/// inwards.
inline void add_spiky_sphere(SceneDescription& scene, int rings, int segments, float low, float high,
                             std::uint64_t seed, std::uint32_t material = 0) {
    Uniforms random(seed);
    const auto vertex = [&](double theta, double phi) {
        const auto radius = static_cast<double>(random.between(low, high));
        return add_vertex(scene, Vec3f{Vec3d{radius * std::sin(theta) * std::cos(phi), radius * std::cos(theta),
                                             radius * std::sin(theta) * std::sin(phi)}});
    };
    const std::uint32_t top = vertex(0.0, 0.0);
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int ring = 1; ring < rings; ++ring)
        for (int s = 0; s < segments; ++s) vertex(0.5 * kTurn * ring / rings, kTurn * s / segments);
    const std::uint32_t bottom = vertex(0.5 * kTurn, 0.0);
    const auto at = [&](int ring, int s) {
        return first + static_cast<std::uint32_t>((ring - 1) * segments + s % segments);
    };
    for (int s = 0; s < segments; ++s) {
        add_triangle(scene, top, at(1, s), at(1, s + 1), material);
        add_triangle(scene, bottom, at(rings - 1, s + 1), at(rings - 1, s), material);
        for (int ring = 1; ring + 1 < rings; ++ring)
            add_quad(scene, at(ring, s), at(ring + 1, s), at(ring + 1, s + 1), at(ring, s + 1), material);
    }
}

/// Rotates about the axis (1, 2, 3) by an angle that no coordinate plane survives, scales, then moves.
inline void transform(SceneDescription& scene, bool rotate, float scale, Vec3f move) {
    const Vec3d axis = glm::normalize(Vec3d{1.0, 2.0, 3.0});
    constexpr double kAngle = 0.7;
    for (glm::vec3& p : scene.positions) {
        Vec3d q{p};
        if (rotate)
            q = q * std::cos(kAngle) + glm::cross(axis, q) * std::sin(kAngle) +
                axis * glm::dot(axis, q) * (1.0 - std::cos(kAngle));
        p = Vec3f{q * static_cast<double>(scale) + Vec3d{move}};
    }
}

}  // namespace pl::test
