#include "core/io/mitsuba/shapes.h"

#include <array>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/parallel.h"
#include "core/io/kept_meshes.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/ply.h"
#include "core/io/mitsuba/round_shapes.h"
#include "core/io/mitsuba/serialized.h"
#include "core/io/obj.h"
#include "core/io/obj_triangles.h"
#include "core/io/triangulate.h"
#include "core/scene/far_origin.h"

namespace pl {
namespace {

/// The square [-1, 1]^2 that faces +z.
ObjMesh rectangle() {
    ObjMesh mesh = empty_mesh();
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_face(
        mesh,
        {{0, ObjCorner::kNone, 0}, {1, ObjCorner::kNone, 1}, {2, ObjCorner::kNone, 2}, {3, ObjCorner::kNone, 3}});
    return mesh;
}

/// [-1, 1]^3, with its corners and images as Mitsuba has them. [Mitsuba 3, cube]
ObjMesh cube() {
    // The corners of each face by the signs of x, y and z: bits 0 to 2.
    constexpr std::array<std::array<int, 4>, 6> kFaces = {
        {{1, 5, 4, 0}, {3, 2, 6, 7}, {1, 3, 7, 5}, {5, 7, 6, 4}, {4, 6, 2, 0}, {3, 1, 0, 2}}};
    ObjMesh mesh = empty_mesh();
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (const std::array<int, 4>& face : kFaces) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const int bits : face)
            mesh.positions.emplace_back((bits & 1) != 0 ? 1 : -1, (bits & 2) != 0 ? 1 : -1, (bits & 4) != 0 ? 1 : -1);
        add_face(mesh, {{first, ObjCorner::kNone, 0},
                        {first + 1, ObjCorner::kNone, 1},
                        {first + 2, ObjCorner::kNone, 2},
                        {first + 3, ObjCorner::kNone, 3}});
    }
    return mesh;
}

ObjMesh mesh_of(PlyMesh read) {
    ObjMesh mesh = empty_mesh();
    const bool has_normals = !read.normals.empty();
    const bool has_uvs = !read.uvs.empty();
    for (const std::array<std::uint32_t, 3>& triangle : read.triangles) {
        const auto corner = [&](std::uint32_t i) {
            return ObjCorner{i, has_normals ? i : ObjCorner::kNone, has_uvs ? i : ObjCorner::kNone};
        };
        add_face(mesh, {corner(triangle[0]), corner(triangle[1]), corner(triangle[2])});
    }
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(-low);
    for (const std::array<std::uint32_t, 3>& triangle : read.triangles) {
        for (const std::uint32_t i : triangle) {
            low = glm::min(low, read.positions[i]);
            high = glm::max(high, read.positions[i]);
        }
    }
    if (!read.triangles.empty()) mesh.origin = far_origin(low, high);
    for (const glm::dvec3& position : read.positions) mesh.positions.emplace_back(position - mesh.origin);
    mesh.normals = std::move(read.normals);
    mesh.uvs = std::move(read.uvs);
    return mesh;
}

/// The content of a file.
struct FileMesh {
    ObjMesh mesh;
    std::vector<glm::vec3> vertex_colors{};
    bool is_flat = false;  ///< the file says that its faces are flat

    bool has_normals() const { return !is_flat && !mesh.normals.empty(); }
};

FileMesh read_file_mesh(const MitsubaObject& shape, const std::filesystem::path& path) {
    if (shape.type() == "obj") return {.mesh = read_obj_mesh(path)};
    if (shape.type() == "ply") {
        PlyMesh read = read_ply(path);
        std::vector<glm::vec3> colors = std::move(read.colors);
        return {.mesh = mesh_of(std::move(read)), .vertex_colors = std::move(colors)};
    }
    PlyMesh read = read_serialized(path, static_cast<std::int64_t>(shape.number("shape_index").value_or(0.0f)));
    const bool is_flat = read.is_flat;
    return {.mesh = mesh_of(std::move(read)), .is_flat = is_flat};
}

/// The colors of a file's vertices, for a surface that shows them.
std::vector<glm::vec3> shown_colors(const MitsubaObject& shape, std::vector<glm::vec3> colors) {
    if (colors.empty()) shape.note("surfaces that show colors of vertices are white on shapes without such");
    for (glm::vec3& color : colors) {
        const glm::vec3 inside = glm::clamp(color, glm::vec3(0.0f), glm::vec3(1.0f));
        if (inside != color) shape.note("colors of vertices outside of [0, 1] are moved into it");
        color = inside;
    }
    return colors;
}

/// Normals as Mitsuba has them: none, the normals of the file, or normals of a smooth surface.
void settle_normals(bool is_flat, ObjMesh& mesh) {
    for (ObjFaces& part : mesh.parts) {
        for (ObjFaces::Run& run : part.runs) run.smoothing = is_flat ? Smoothing::Off : Smoothing::On;
        for (ObjCorner& corner : part.corners) corner.normal = is_flat ? ObjCorner::kNone : corner.normal;
    }
    smooth_normals(mesh);
}

/// `mesh` has positions, their origin, and normals.
template <class Mesh>
void move(const MitsubaObject& shape, const glm::dmat4& to_world, Mesh& mesh) {
    const glm::dmat3 m(to_world);
    glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const bool is_mirrored = glm::dot(cofactors[0], m[0]) < 0.0;
    for (glm::vec3& position : mesh.positions) {
        const glm::dvec3 moved(to_world * glm::dvec4(mesh.origin + glm::dvec3(position), 1.0));
        if (!(std::abs(moved.x) <= kLargestCoordinate && std::abs(moved.y) <= kLargestCoordinate &&
              std::abs(moved.z) <= kLargestCoordinate)) {
            shape.fail(fmt::format("expected coordinates up to {} in the world, got {}, {}, {}", kLargestCoordinate,
                                   moved.x, moved.y, moved.z));
        }
        position = glm::vec3(moved);
    }
    mesh.origin = glm::dvec3(0.0);
    for (glm::vec3& normal : mesh.normals) {
        const glm::dvec3 turned = (is_mirrored ? -1.0 : 1.0) * (cofactors * glm::dvec3(normal));
        const double length = glm::length(turned);
        normal = length > 0.0 && std::isfinite(length) ? glm::vec3(turned / length) : glm::vec3(0.0f);
    }
}

/// The first row of an image is at v = 0 in Mitsuba, whose OBJ reader turns images over as this does; here it is at v = 1.
void turn_images_over(ObjMesh& mesh) {
    for (glm::vec2& uv : mesh.uvs) uv.y = 1.0f - uv.y;
}

/// Turns the front of all faces to their other side.
void turn_over(ObjMesh& mesh) {
    for (ObjFaces& part : mesh.parts) {
        std::size_t first = 0;
        for (const std::uint32_t count : part.corner_counts) {
            const auto begin = part.corners.begin() + static_cast<std::ptrdiff_t>(first);
            std::reverse(begin, begin + static_cast<std::ptrdiff_t>(count));
            first += count;
        }
    }
}

}  // namespace

void add_mitsuba_shape(const MitsubaObject& shape, const ShapeMaterial& material, const RoundShapes& round_shapes,
                       SceneDescription& scene) {
    const std::string type = shape.type();
    glm::dmat4 to_world = shape.transform("to_world");
    to_world[3] -= glm::dvec4(scene.origin, 0.0);
    ObjMesh mesh;
    SceneDescription added;
    std::vector<glm::vec3> vertex_colors;
    added.source = scene.source;
    // A mirrored sphere, and a mesh whose corners decide about its front, turn inside out. [Mitsuba 3]
    bool keeps_front = type != "sphere";
    if (type == "obj" || type == "ply" || type == "serialized") {
        added.source = shape.file("filename");
        scene.files.push_back(added.source);
        std::error_code ignored;
        if (!std::filesystem::exists(added.source, ignored)) {
            shape.leave_out(fmt::format("no such file: {}: its shape is left out", added.source.string()));
            return;
        }
        FileMesh read = read_file_mesh(shape, added.source);
        read.is_flat = read.is_flat || shape.boolean("face_normals").value_or(false);
        keeps_front = read.has_normals();
        mesh = std::move(read.mesh);
        vertex_colors = std::move(read.vertex_colors);
        settle_normals(read.is_flat, mesh);
    } else if (type == "rectangle") {
        mesh = rectangle();
    } else if (type == "cube") {
        mesh = cube();
    } else if (type == "disk") {
        mesh = disk_mesh(round_shapes.sides(material.emits));
        shape.note("disks are polygons of their area");
    } else if (type == "sphere") {
        mesh = sphere_mesh(round_shapes.sides(material.emits));
        shape.note("spheres are fine meshes of their area");
        to_world = glm::scale(glm::translate(to_world, shape.point("center").value_or(glm::dvec3(0.0))),
                              glm::dvec3(static_cast<double>(shape.number("radius").value_or(1.0f))));
    } else {
        shape.leave_out(fmt::format("shapes of the type {} are left out", in_quotes(type)));
        return;
    }
    if (!shape.boolean("flip_tex_coords").value_or(type == "obj")) turn_images_over(mesh);
    move(shape, to_world, mesh);
    const bool is_mirrored = keeps_front && glm::determinant(glm::dmat3(to_world)) < 0.0;
    const bool is_flipped = shape.boolean("flip_normals").value_or(false) != material.is_inside_out;
    if (is_mirrored != is_flipped) turn_over(mesh);
    const MaterialTable materials{.of_name = std::vector<std::uint32_t>(mesh.materials.size(), material.index),
                                  .fallback = material.index};
    add_obj_triangles(added, std::move(mesh), materials, nullptr, usable_threads());
    if (material.shows_vertex_colors) added.vertex_colors = shown_colors(shape, std::move(vertex_colors));
    append_triangles(std::move(added), scene);
}

SceneDescription copy_of_group(const MitsubaObject& instance, const SceneDescription& group,
                               const glm::dmat4& to_world) {
    SceneDescription copy;
    copy.positions = group.positions;
    copy.vertex_colors = group.vertex_colors;
    copy.normals = group.normals;
    copy.uvs = group.uvs;
    copy.triangles = group.triangles;
    move(instance, to_world, copy);
    if (glm::determinant(glm::dmat3(to_world)) < 0.0) {
        for (TriangleDescription& triangle : copy.triangles) {
            std::swap(triangle.vertex.y, triangle.vertex.z);
            std::swap(triangle.normal.y, triangle.normal.z);
            std::swap(triangle.uv.y, triangle.uv.z);
        }
    }
    return copy;
}

}  // namespace pl
