#include "core/io/mitsuba/round_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

namespace pl {
namespace {

RoundShapes count_in(const std::vector<MitsubaObject>& objects) {
    RoundShapes count;
    for (const MitsubaObject& object : objects) {
        if (object.type() != "sphere" && object.type() != "disk") continue;
        const bool emits = std::ranges::any_of(
            object.children(), [](const MitsubaObject& child) { return child.target().element() == "emitter"; });
        ++(emits ? count.emitting : count.others);
    }
    return count;
}

/// A point of the sphere of radius 1.
glm::dvec3 sphere_point(std::uint32_t row, std::uint32_t column, std::uint32_t sides) {
    const double theta = glm::two_pi<double>() * row / sides;
    const double phi = glm::two_pi<double>() * (column % sides) / sides;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Area of a mesh with its vertices on the sphere of radius 1: all columns are alike.
double inscribed_area(std::uint32_t sides) {
    double area = 0.0;
    for (std::uint32_t row = 0; row < sides / 2; ++row) {
        const std::array<glm::dvec3, 4> p = {sphere_point(row, 0, sides), sphere_point(row + 1, 0, sides),
                                             sphere_point(row, 1, sides), sphere_point(row + 1, 1, sides)};
        area += 0.5 * (glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) +
                       glm::length(glm::cross(p[1] - p[2], p[3] - p[2])));
    }
    return area * sides;
}

}  // namespace

std::uint32_t RoundShapes::sides(bool emits) const {
    if (emits) {
        if (emitting <= 4) return 64;
        return emitting <= 100 ? 32 : 16;
    }
    if (others <= 16) return 256;
    if (others <= 100) return 128;
    return others <= 1000 ? 64 : 32;
}

RoundShapes count_round_shapes(const MitsubaFile& file) {
    RoundShapes all = count_in(file.objects());
    std::map<const void*, std::size_t> emitting_of_group;
    for (const MitsubaObject& object : file.objects()) {
        if (object.type() != "shapegroup") continue;
        const RoundShapes group = count_in(object.children());
        all.others += group.others;
        if (group.emitting > 0) emitting_of_group[object.identity()] = group.emitting;
    }
    if (emitting_of_group.empty()) return all;
    for (const MitsubaObject& object : file.objects()) {
        if (object.type() != "instance") continue;
        for (const MitsubaObject& child : object.children()) {
            const auto group = emitting_of_group.find(child.target().identity());
            if (group != emitting_of_group.end()) all.emitting += group->second;
        }
    }
    return all;
}

ObjMesh sphere_mesh(std::uint32_t sides) {
    const std::uint32_t rows = sides / 2;
    // The mesh has the area of the sphere, so that a sphere that emits has its power. A convex body hides a quarter
    // of its area in the mean over all directions [Cauchy 1841], so that the silhouette has the right size in the
    // mean, too. Vertices on the sphere would make the silhouette too small.
    const double radius = std::sqrt(4.0 * glm::pi<double>() / inscribed_area(sides));
    ObjMesh mesh = empty_mesh();
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= sides; ++column) {
            const glm::dvec3 normal = sphere_point(row, column, sides);
            mesh.positions.emplace_back(radius * normal);
            mesh.normals.emplace_back(normal);
            mesh.uvs.emplace_back(static_cast<float>(column) / static_cast<float>(sides),
                                  static_cast<float>(row) / static_cast<float>(rows));
        }
    }
    const auto corner = [sides](std::uint32_t row, std::uint32_t column) {
        const std::uint32_t i = row * (sides + 1) + column;
        return ObjCorner{i, i, i};
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < sides; ++column) {
            if (row > 0) add_face(mesh, {corner(row, column), corner(row + 1, column), corner(row, column + 1)});
            if (row + 1 < rows)
                add_face(mesh, {corner(row, column + 1), corner(row + 1, column), corner(row + 1, column + 1)});
        }
    }
    return mesh;
}

ObjMesh disk_mesh(std::uint32_t sides) {
    const double turn = glm::two_pi<double>() / sides;
    const double radius = std::sqrt(turn / std::sin(turn));  // the mesh has the area of the disk
    ObjMesh mesh = empty_mesh();
    mesh.positions.emplace_back(0.0f);
    for (std::uint32_t i = 0; i < sides; ++i)
        mesh.positions.emplace_back(radius * std::cos(turn * i), radius * std::sin(turn * i), 0.0);
    const auto share = [sides](double i) { return static_cast<float>(i / sides); };
    for (std::uint32_t i = 0; i <= sides; ++i) mesh.uvs.emplace_back(1.0f, share(i));
    for (std::uint32_t i = 0; i < sides; ++i) {
        // At the middle every side has its own angle.
        mesh.uvs.emplace_back(0.0f, share(i + 0.5));
        add_face(mesh, {{0, ObjCorner::kNone, sides + 1 + i},
                        {i + 1, ObjCorner::kNone, i},
                        {(i + 1) % sides + 1, ObjCorner::kNone, i + 1}});
    }
    return mesh;
}

}  // namespace pl
