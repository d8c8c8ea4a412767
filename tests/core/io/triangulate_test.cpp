// Polygons are covered exactly once by their triangles.
#include "core/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

using Polygon = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double outline_area(const Polygon& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        sum += 0.5 * cross({0.0, 0.0}, polygon[i], polygon[(i + 1) % polygon.size()]);
    }
    return sum;
}

/// Even-odd rule.
bool is_inside(const Polygon& polygon, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

/// Checks count, orientation, area and, at random points, that inside is covered once and outside never.
void check_cover(const Polygon& polygon, const glm::dmat3& to_space, const glm::dvec3& offset) {
    std::vector<glm::vec3> corners;
    Polygon rounded;  // the polygon that the floats describe
    const glm::dmat3 back = glm::transpose(to_space);
    for (const glm::dvec2& p : polygon) {
        corners.emplace_back(glm::vec3(to_space * glm::dvec3(p, 0.0) + offset));
        rounded.emplace_back(back * (glm::dvec3(corners.back()) - offset));
    }
    const Triangulation cut = triangulate(corners);
    CHECK(cut.exact);
    REQUIRE(cut.triangles.size() == polygon.size() - 2);
    double covered = 0.0;
    int turned = 0;
    for (const auto& [a, b, c] : cut.triangles) {
        const double twice = cross(rounded[a], rounded[b], rounded[c]);
        turned += twice < -1e-6 ? 1 : 0;
        covered += 0.5 * std::abs(twice);
    }
    CHECK(turned == 0);
    // Float rounding moves every corner out of the plane by up to 6e-8 of the coordinates, here up to 40.
    CHECK(covered == Approx(outline_area(rounded)).epsilon(1e-6));

    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.2, 3.2);
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec2 p(uniform(random), uniform(random));
        int times = 0;
        double margin = 1.0;
        for (const auto& [a, b, c] : cut.triangles) {
            const double u = cross(rounded[a], rounded[b], p);
            const double v = cross(rounded[b], rounded[c], p);
            const double w = cross(rounded[c], rounded[a], p);
            margin = std::min({margin, std::abs(u), std::abs(v), std::abs(w)});
            times += u > 0.0 && v > 0.0 && w > 0.0 ? 1 : 0;
        }
        wrong += margin > 1e-4 && times != (is_inside(rounded, p) ? 1 : 0) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

Polygon star(int tips) {
    Polygon result;
    for (int i = 0; i < 2 * tips; ++i) {
        const double radius = i % 2 == 0 ? 1.5 : 0.4;
        const double angle = std::numbers::pi * i / tips + 0.1;
        result.emplace_back(1.5 + radius * std::cos(angle), 1.5 + radius * std::sin(angle));
    }
    return result;
}

}  // namespace

TEST_CASE("Polygons of all shapes, places and planes are covered once") {
    const auto polygon = GENERATE(
        Polygon{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, Polygon{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
        Polygon{{0, 1}, {3, 0}, {2.5, 1}, {3, 2}}, Polygon{{3, 0}, {2.5, 1}, {3, 2}, {0, 1}},     // darts
        Polygon{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},                  // U
        Polygon{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {1.5, 3}, {0, 3}, {0, 1}},                // corners on edges
        Polygon{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}},  // ring with a cut
        star(5), star(20));
    const auto offset = GENERATE(glm::dvec3(0.0), glm::dvec3(-30, 20, 10), glm::dvec3(7, -40, 3));
    const double angle = GENERATE(0.0, 0.7, 2.9);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const glm::dmat3 turn = glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c) * glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c);
    for (std::size_t shift = 0; shift < polygon.size(); ++shift) {
        Polygon shifted(polygon);
        std::rotate(shifted.begin(), shifted.begin() + static_cast<std::ptrdiff_t>(shift), shifted.end());
        check_cover(shifted, turn, offset);
    }
}

TEST_CASE("A quad is cut along the shorter diagonal, a dart along the one inside") {
    const std::vector<glm::vec3> kite = {{0, 0, 0}, {2, -1, 0}, {5, 0, 0}, {2, 1, 0}};
    CHECK(triangulate(kite).triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}});
    const std::vector<glm::vec3> dart = {{10, -1, 0}, {9, 0, 0}, {10, 1, 0}, {0, 0, 0}};
    CHECK(triangulate(dart).triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("A quad with one corner twice is one triangle and one without area") {
    const glm::vec3 a(0, 0, 0);
    const glm::vec3 b(1, 0, 0);
    const glm::vec3 c(0, 1, 0);
    for (const std::vector<glm::vec3>& quad : {std::vector{a, a, b, c}, {a, b, b, c}, {a, b, c, c}, {a, b, c, a}}) {
        const Triangulation cut = triangulate(quad);
        CHECK(cut.exact);
        double area = 0.0;
        for (const auto& [i, j, k] : cut.triangles) {
            area += 0.5 * static_cast<double>(glm::length(glm::cross(quad[j] - quad[i], quad[k] - quad[i])));
        }
        CHECK(area == Approx(0.5));
    }
}

TEST_CASE("Outlines that cross themselves or have no area become a fan and say so") {
    const std::vector<glm::vec3> bow_tie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::vec3> pentagram = {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}};
    const std::vector<glm::vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    const std::vector<glm::vec3> point(7, glm::vec3(1, 2, 3));
    for (const auto& corners : {bow_tie, pentagram, line, point}) {
        const Triangulation cut = triangulate(corners);
        CHECK_FALSE(cut.exact);
        CHECK(cut.triangles.size() == corners.size() - 2);
    }
}

TEST_CASE("A quad bent out of its plane is cut like its projection") {
    const std::vector<glm::vec3> bent = {
        {552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}};
    const Triangulation cut = triangulate(bent);
    CHECK(cut.exact);
    CHECK(cut.triangles.size() == 2);
}

TEST_CASE("Polygons of many corners keep their area") {
    const int count = GENERATE(5, 100, 1000, 10000);
    const bool jagged = GENERATE(false, true);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const double radius = jagged && i % 2 == 1 ? 0.9 : 1.0;
        corners.emplace_back(10.0 + radius * std::cos(angle), 5.0, radius * std::sin(angle));
    }
    double expected = 0.0;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i]), glm::dvec3(corners[(i + 1) % corners.size()]));
    }
    expected = 0.5 * std::abs(sum.y);
    const Triangulation cut = triangulate(corners);
    CHECK(cut.exact);
    CHECK(cut.triangles.size() == corners.size() - 2);
    double covered = 0.0;
    for (const auto& [a, b, c] : cut.triangles) {
        covered += 0.5 * glm::length(glm::cross(glm::dvec3(corners[b]) - glm::dvec3(corners[a]),
                                                glm::dvec3(corners[c]) - glm::dvec3(corners[a])));
    }
    CHECK(covered == Approx(expected).epsilon(1e-9));
}
