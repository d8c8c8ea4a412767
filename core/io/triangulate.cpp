#include "core/io/triangulate.h"

#include <cmath>
#include <limits>
#include <utility>

namespace pl {

namespace {

using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

/// Projects the corners along the largest coordinate of the normal, such that the polygon is counter-clockwise. No
/// coordinate is rounded, so orientations are decided on the numbers of the file.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
    glm::dvec3 normal(0.0);  // Newell's method: twice the vector area
    const glm::dvec3 base(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        normal += glm::cross(glm::dvec3(corners[i]) - base, glm::dvec3(corners[i + 1]) - base);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    int u = (drop + 1) % 3;
    int v = (drop + 2) % 3;
    if (normal[drop] < 0.0) {
        std::swap(u, v);
    }
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        flat.emplace_back(corner[u], corner[v]);
    }
    return flat;
}

/// Twice the signed area of a triangle, positive if counter-clockwise.
double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether the triangles cover the polygon exactly once: the sum of their absolute areas equals its area.
bool covers_exactly(const std::vector<glm::dvec2>& flat, const std::vector<Triangle>& triangles) {
    double outline = 0.0;
    double magnitude = 0.0;  // scale of the rounding errors
    for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
        const double area = orientation(flat[0], flat[i], flat[i + 1]);
        outline += area;
        magnitude += std::abs(area);
    }
    double covered = 0.0;
    for (const Triangle& t : triangles) {
        covered += std::abs(orientation(flat[t[0]], flat[t[1]], flat[t[2]]));
    }
    // Two sums of n terms, each rounded three times: (2n + 6) u times the sum of magnitudes, doubled for safety.
    const double rounding = std::numeric_limits<double>::epsilon() * 2.0 * (static_cast<double>(flat.size()) + 3.0);
    return outline > 0.0 && std::abs(covered - outline) <= rounding * (magnitude + covered);
}

Triangulation fan(std::size_t corner_count) {
    Triangulation result{.triangles = {}, .exact = false};
    for (Index i = 1; i + 1 < corner_count; ++i) {
        result.triangles.push_back({0, i, i + 1});
    }
    return result;
}

Triangulation cut_quad(std::span<const glm::vec3> corners, const std::vector<glm::dvec2>& flat) {
    const auto inside = [&](Index a, Index b, Index c, Index d) {
        return orientation(flat[a], flat[b], flat[c]) > 0.0 && orientation(flat[a], flat[c], flat[d]) > 0.0;
    };
    const bool first_inside = inside(0, 1, 2, 3);
    const bool second_inside = inside(1, 2, 3, 0);
    if (!first_inside && !second_inside) {
        Triangulation plain = fan(4);
        plain.exact = covers_exactly(flat, plain.triangles);  // inexact for a triangle with a repeated corner
        return plain;
    }
    const glm::dvec3 first = glm::dvec3(corners[2]) - glm::dvec3(corners[0]);
    const glm::dvec3 second = glm::dvec3(corners[3]) - glm::dvec3(corners[1]);
    const bool first_shorter = glm::dot(first, first) < glm::dot(second, second);
    if (first_inside && (first_shorter || !second_inside)) {
        return {.triangles = {{0, 1, 2}, {0, 2, 3}}};
    }
    return {.triangles = {{0, 1, 3}, {1, 2, 3}}};
}

/// The remaining outline as a linked ring, and its corners that are not strictly convex: only those can block an ear.
class EarClipper {
public:
    explicit EarClipper(const std::vector<glm::dvec2>& flat)
        : flat_(flat), next_(flat.size()), previous_(flat.size()), blocking_(flat.size(), false) {
        const auto count = static_cast<Index>(flat.size());
        for (Index i = 0; i < count; ++i) {
            next_[i] = (i + 1) % count;
            previous_[i] = (i + count - 1) % count;
        }
        for (Index i = 0; i < count; ++i) {
            blocking_[i] = !is_convex(i);
            if (blocking_[i]) {
                blockers_.push_back(i);
            }
        }
    }

    /// False if no ear is left among more than three corners.
    bool clip_all(std::vector<Triangle>& triangles) {
        Index at = 0;
        std::size_t left = flat_.size();
        std::size_t refused = 0;
        while (left > 3) {
            if (refused > left) {
                return false;
            }
            if (!is_ear(at)) {
                at = next_[at];
                ++refused;
                continue;
            }
            triangles.push_back({previous_[at], at, next_[at]});
            at = remove(at);
            --left;
            refused = 0;
        }
        triangles.push_back({previous_[at], at, next_[at]});
        return true;
    }

private:
    bool is_convex(Index i) const { return orientation(flat_[previous_[i]], flat_[i], flat_[next_[i]]) > 0.0; }

    bool is_ear(Index i) const {
        if (blocking_[i]) {
            return false;
        }
        const glm::dvec2 a = flat_[previous_[i]];
        const glm::dvec2 b = flat_[i];
        const glm::dvec2 c = flat_[next_[i]];
        const glm::dvec2 low = glm::min(a, glm::min(b, c));
        const glm::dvec2 high = glm::max(a, glm::max(b, c));
        for (const Index k : blockers_) {
            const glm::dvec2 p = flat_[k];
            if (!blocking_[k] || p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) {
                continue;
            }
            // The outline touches itself at a corner with equal coordinates, as along a cut to a hole.
            const bool same_place = p == a || p == b || p == c;
            if (!same_place && orientation(a, b, p) >= 0.0 && orientation(b, c, p) >= 0.0 &&
                orientation(c, a, p) >= 0.0) {
                return false;
            }
        }
        return true;
    }

    /// Removes the corner; returns the next candidate, one corner further so that the triangles do not form a fan.
    Index remove(Index i) {
        const Index before = previous_[i];
        const Index after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        blocking_[i] = false;
        // Clipping an ear never makes its neighbors less convex.
        blocking_[before] = blocking_[before] && !is_convex(before);
        blocking_[after] = blocking_[after] && !is_convex(after);
        if (++removed_since_cleanup_ > blockers_.size()) {
            std::erase_if(blockers_, [this](Index k) { return !blocking_[k]; });
            removed_since_cleanup_ = 0;
        }
        return next_[after];
    }

    const std::vector<glm::dvec2>& flat_;
    std::vector<Index> next_;
    std::vector<Index> previous_;
    std::vector<bool> blocking_;
    std::vector<Index> blockers_;
    std::size_t removed_since_cleanup_ = 0;
};

}  // namespace

Triangulation triangulate(std::span<const glm::vec3> corners) {
    if (corners.size() == 3) {
        return {.triangles = {{0, 1, 2}}};
    }
    const std::vector<glm::dvec2> flat = project(corners);
    if (corners.size() == 4) {
        return cut_quad(corners, flat);
    }
    Triangulation result;
    result.triangles.reserve(corners.size() - 2);
    if (!EarClipper(flat).clip_all(result.triangles) || !covers_exactly(flat, result.triangles)) {
        return fan(corners.size());
    }
    return result;
}

}  // namespace pl
