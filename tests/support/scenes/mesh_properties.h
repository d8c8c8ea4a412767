// Properties of the bodies of a scene: sets of triangles that share vertices.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/scene/description.h"

namespace pl::test {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Body = std::vector<TriangleDescription>;

/// Connected components, in the order of their first triangles.
inline std::vector<Body> bodies(const SceneDescription& scene) {
    std::vector<std::uint32_t> parent(scene.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) {
            v = parent[v];
        }
        return v;
    };
    for (const TriangleDescription& t : scene.triangles) {
        parent[root(t.vertex.y)] = root(t.vertex.x);
        parent[root(t.vertex.z)] = root(t.vertex.x);
    }
    std::vector<Body> result;
    std::map<std::uint32_t, std::size_t> body_of;
    for (const TriangleDescription& t : scene.triangles) {
        const auto [entry, is_new] = body_of.try_emplace(root(t.vertex.x), result.size());
        if (is_new) {
            result.emplace_back();
        }
        result[entry->second].push_back(t);
    }
    return result;
}

/// Directed edges without exactly one partner in the opposite direction: empty if closed and consistently oriented.
inline std::vector<Edge> open_edges(const Body& body) {
    std::map<Edge, int> count;
    for (const TriangleDescription& t : body) {
        for (int k = 0; k < 3; ++k) {
            ++count[{t.vertex[k], t.vertex[(k + 1) % 3]}];
        }
    }
    std::vector<Edge> open;
    for (const auto& [edge, times] : count) {
        const auto partner = count.find({edge.second, edge.first});
        if (times != 1 || partner == count.end() || partner->second != 1) {
            open.push_back(edge);
        }
    }
    return open;
}

inline glm::dvec3 position(const SceneDescription& scene, std::uint32_t vertex) {
    return glm::dvec3(scene.positions[vertex]);
}

/// Twice the area, as a vector along the front side's normal.
inline glm::dvec3 area_vector(const SceneDescription& scene, const TriangleDescription& t) {
    const glm::dvec3 a = position(scene, t.vertex.x);
    return glm::cross(position(scene, t.vertex.y) - a, position(scene, t.vertex.z) - a);
}

inline double area(const SceneDescription& scene) {
    double sum = 0.0;
    for (const TriangleDescription& t : scene.triangles) {
        sum += 0.5 * glm::length(area_vector(scene, t));
    }
    return sum;
}

/// Volume of the cone over the body from `apex`: the body's volume if it is closed (or open only towards a plane
/// through the apex), positive if its fronts look outwards.
inline double signed_volume(const SceneDescription& scene, const Body& body, const glm::dvec3& apex) {
    double sum = 0.0;
    for (const TriangleDescription& t : body) {
        sum += glm::dot(position(scene, t.vertex.x) - apex, area_vector(scene, t)) / 6.0;
    }
    return sum;
}

}  // namespace pl::test
