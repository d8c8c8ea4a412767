#include "core/io/gltf/primitives.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/io/gltf/accessors.h"
#include "core/io/kept_meshes.h"
#include "core/io/triangulate.h"

namespace pl {
namespace {

/// Modes of primitives, OpenGL's numbers.
enum class Mode : std::uint32_t { Triangles = 4, Strip = 5, Fan = 6 };
constexpr std::uint64_t kLastMode = 6;

template <class Vector>
std::vector<Vector> as_vectors(const std::vector<float>& values) {
    constexpr auto kLength = static_cast<std::size_t>(Vector::length());
    std::vector<Vector> vectors(values.size() / kLength);
    for (std::size_t i = 0; i < values.size(); ++i) vectors[i / kLength][static_cast<int>(i % kLength)] = values[i];
    return vectors;
}

/// Corners of the triangle `i` of a primitive. [glTF 2.0, section 3.7.2.1]
std::array<std::size_t, 3> corners_of(Mode mode, std::size_t i) {
    switch (mode) {
    case Mode::Triangles: break;
    case Mode::Strip: return {i, i + 1 + i % 2, i + 2 - i % 2};
    case Mode::Fan: return {i + 1, i + 2, 0};
    }
    return {3 * i, 3 * i + 1, 3 * i + 2};
}

}  // namespace

const std::vector<GltfPrimitive>& GltfMeshes::mesh(std::uint32_t number) {
    const auto [known, is_new] = known_.try_emplace(number);
    if (is_new) {
        const std::string at = fmt::format("/meshes/{}/primitives", number);
        for (std::size_t i = 0; i < file_.json().array_size(at); ++i)
            known->second.push_back(read(fmt::format("{}/{}", at, i)));
    }
    return known->second;
}

GltfPrimitive GltfMeshes::read(const std::string& at) {
    GltfPrimitive primitive{.at = at};
    primitive.surface = file_.index(at + "/material", "materials").value_or(standard_);
    if (surfaces_[primitive.surface].is_hidden) return primitive;
    if (file_.whole(at + "/mode", 4, 0, kLastMode) < static_cast<std::uint64_t>(Mode::Triangles)) {
        file_.note("points and lines are left out", at);
        return primitive;
    }
    read_attributes(primitive);
    if (surfaces_[primitive.surface].is_hidden) return {.at = at, .surface = primitive.surface};
    if (!primitive.positions.empty()) read_triangles(primitive);
    return primitive;
}

void GltfMeshes::count(const std::string& at, std::uint64_t elements) {
    elements_ += elements;
    if (elements_ > kMostStoredVertices) {
        file_.fail(at, fmt::format("expected at most {} vertices and corners in the file, got {} and more",
                                   kMostStoredVertices, elements_));
    }
}

std::optional<std::uint32_t> GltfMeshes::attribute(const GltfPrimitive& primitive, const std::string& name) {
    const std::string at = primitive.at + "/attributes/" + name;
    const std::optional<std::uint32_t> accessor = file_.index(at, "accessors");
    if (accessor && accessor_count(file_, *accessor) != primitive.positions.size()) {
        file_.fail(at, fmt::format("expected one element for each of the {} vertices, got {}",
                                   primitive.positions.size(), accessor_count(file_, *accessor)));
    }
    return accessor;
}

void GltfMeshes::read_attributes(GltfPrimitive& primitive) {
    const std::optional<std::uint32_t> positions = file_.index(primitive.at + "/attributes/POSITION", "accessors");
    if (!positions) {
        file_.note("primitives without positions are left out", primitive.at);
        return;
    }
    if (!file_.json().has(fmt::format("/accessors/{}/bufferView", *positions))) file_.refuse_compressed(primitive.at);
    count(primitive.at, accessor_count(file_, *positions));
    primitive.positions = as_vectors<glm::vec3>(read_floats(file_, *positions, "VEC3"));
    if (const auto normals = attribute(primitive, "NORMAL"))
        primitive.normals = as_vectors<glm::vec3>(read_floats(file_, *normals, "VEC3"));
    read_uvs(primitive, primitive.positions.size());
    const auto joints = attribute(primitive, "JOINTS_0");
    const auto weights = attribute(primitive, "WEIGHTS_0");
    if (joints && weights) {
        primitive.joints = read_integers(file_, *joints, "VEC4");
        primitive.weights = read_floats(file_, *weights, "VEC4");
    }
    read_colors(primitive);
    if (surfaces_[primitive.surface].is_anisotropic && file_.json().has(primitive.at + "/attributes/TANGENT"))
        file_.note("tangents are left out: texture coordinates decide the direction of anisotropy", primitive.at);
    if (file_.json().has(primitive.at + "/targets"))
        file_.note("morph targets are left out: the base shape is shown", primitive.at);
    for (const char* more : {"/attributes/JOINTS_1", "/extensions/KHR_materials_variants"})
        if (file_.json().has(primitive.at + more))
            file_.note(fmt::format("{} is left out", std::strrchr(more, '/') + 1), primitive.at + more);
}

void GltfMeshes::read_colors(GltfPrimitive& primitive) {
    const auto accessor = attribute(primitive, "COLOR_0");
    if (!accessor) return;
    const std::string at = primitive.at + "/attributes/COLOR_0";
    const bool has_alpha = accessor_type(file_, *accessor) == "VEC4";
    const std::vector<float> values = read_floats(file_, *accessor, has_alpha ? "VEC4" : "VEC3");
    const std::size_t channels = has_alpha ? 4 : 3;
    bool is_white = true;
    OpacityRange opacities{.least = 1.0f, .most = 0.0f};
    for (std::size_t i = 0; i + channels <= values.size(); i += channels) {
        const glm::vec3 color(values[i], values[i + 1], values[i + 2]);
        const glm::vec3 inside = glm::clamp(color, glm::vec3(0.0f), glm::vec3(1.0f));
        if (inside != color) file_.note("colors of vertices outside of [0, 1] are moved into it", at);
        const float opacity = has_alpha ? std::clamp(values[i + 3], 0.0f, 1.0f) : 1.0f;
        opacities = {.least = std::min(opacities.least, opacity), .most = std::max(opacities.most, opacity)};
        is_white = is_white && inside == glm::vec3(1.0f);
        primitive.colors.push_back(inside);
    }
    if (is_white) primitive.colors.clear();
    primitive.surface = opacities_.surface_with(primitive.surface, opacities, at);
}

void GltfMeshes::read_uvs(GltfPrimitive& primitive, std::size_t vertices) {
    const UvMapping& mapping = surfaces_[primitive.surface].uv;
    const std::string name = fmt::format("TEXCOORD_{}", mapping.set);
    const auto accessor = attribute(primitive, name);
    if (!accessor) return;
    primitive.uvs = as_vectors<glm::vec2>(read_floats(file_, *accessor, "VEC2"));
    for (std::size_t i = 0; i < vertices; ++i) {
        glm::vec2& uv = primitive.uvs[i];
        uv = mapping.apply(uv);
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            file_.fail(primitive.at + "/attributes/" + name,
                       fmt::format("expected finite texture coordinates, got those of vertex {}", i));
        }
    }
}

std::vector<std::uint32_t> GltfMeshes::read_corners(const GltfPrimitive& primitive) {
    const std::string at = primitive.at + "/indices";
    const std::optional<std::uint32_t> accessor = file_.index(at, "accessors");
    if (!accessor) return {};
    count(at, accessor_count(file_, *accessor));
    std::vector<std::uint32_t> corners = read_integers(file_, *accessor, "SCALAR");
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] >= primitive.positions.size()) {
            file_.fail(at, fmt::format("expected indices below {}, the number of vertices, got {} at corner {}",
                                       primitive.positions.size(), corners[i], i));
        }
    }
    return corners;
}

void GltfMeshes::read_triangles(GltfPrimitive& primitive) {
    const auto mode = static_cast<Mode>(file_.whole(primitive.at + "/mode", 4, 0, kLastMode));
    const std::vector<std::uint32_t> corners = read_corners(primitive);
    const bool is_indexed = file_.json().has(primitive.at + "/indices");
    const std::size_t count = is_indexed ? corners.size() : primitive.positions.size();
    const std::size_t triangles = mode == Mode::Triangles ? count / 3 : std::max<std::size_t>(count, 2) - 2;
    if (mode == Mode::Triangles && count % 3 != 0)
        file_.note("corners without a triangle are left out: their number is not divisible by 3", primitive.at);
    primitive.triangles.resize(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::array<std::size_t, 3> of = corners_of(mode, i);
        for (std::size_t k = 0; k < 3; ++k)
            primitive.triangles[i][k] = is_indexed ? corners[of[k]] : static_cast<std::uint32_t>(of[k]);
    }
}

namespace {

constexpr glm::vec3 kWhite(1.0f);

/// Transformation of normals: the inverse transposed without its factor, which may be infinite.
glm::dmat3 normal_transform(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(cofactors[0], m[0]) < 0.0 ? -cofactors : cofactors;
}

class PrimitiveCopier {
public:
    PrimitiveCopier(GltfFile& file, const GltfPrimitive& primitive, const GltfPlace& place, SceneDescription& to)
        : file_(file), primitive_(primitive), place_(place), to_(to),
          is_skinned_(!place.joints.empty() && !primitive.joints.empty()),
          first_vertex_(static_cast<std::uint32_t>(to.positions.size())),
          first_normal_(static_cast<std::uint32_t>(to.normals.size())),
          first_uv_(static_cast<std::uint32_t>(to.uvs.size())) {}

    void add_vertices() {
        glm::dmat3 turn = normal_transform(glm::dmat3(place_.to_world));
        for (std::size_t i = 0; i < primitive_.positions.size(); ++i) {
            const glm::dmat4 matrix = is_skinned_ ? skin_transform(i) : place_.to_world;
            add_position(glm::dvec3(matrix * glm::dvec4(glm::dvec3(primitive_.positions[i]), 1.0)));
            if (primitive_.normals.empty()) continue;
            turn = is_skinned_ ? normal_transform(glm::dmat3(matrix)) : turn;
            const glm::dvec3 normal = turn * glm::dvec3(primitive_.normals[i]);
            const double length = glm::length(normal);
            const bool is_usable = length > 0.0 && std::isfinite(length);
            to_.normals.push_back(is_usable ? glm::vec3(normal / length) : glm::vec3(0.0f));
        }
        to_.uvs.insert(to_.uvs.end(), primitive_.uvs.begin(), primitive_.uvs.end());
        if (primitive_.colors.empty()) return;
        to_.vertex_colors.resize(first_vertex_, kWhite);
        to_.vertex_colors.insert(to_.vertex_colors.end(), primitive_.colors.begin(), primitive_.colors.end());
    }

    void add_triangles(std::uint32_t material) {
        const bool is_mirrored = !is_skinned_ && glm::determinant(glm::dmat3(place_.to_world)) < 0.0;
        for (std::array<std::uint32_t, 3> corner : primitive_.triangles) {
            if (is_mirrored) std::swap(corner[1], corner[2]);
            const glm::uvec3 of(corner[0], corner[1], corner[2]);
            TriangleDescription triangle{.vertex = first_vertex_ + of, .material = material};
            if (!has_area(to_.positions[triangle.vertex.x], to_.positions[triangle.vertex.y],
                          to_.positions[triangle.vertex.z])) {
                file_.note("triangles without area are removed", primitive_.at);
                continue;
            }
            if (!primitive_.normals.empty()) set_normals(first_normal_ + of, triangle);
            if (!primitive_.uvs.empty()) triangle.uv = first_uv_ + of;
            to_.triangles.push_back(triangle);
        }
    }

private:
    void add_position(const glm::dvec3& position) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(position[axis]) <= kLargestCoordinate)) {
                file_.fail(primitive_.at, fmt::format("expected coordinates up to {} in the world, got {}",
                                                      kLargestCoordinate, position[axis]));
            }
        }
        to_.positions.emplace_back(position);
    }

    /// Mean of the places of the joints of a vertex. [glTF 2.0, section 3.7.3.3]
    glm::dmat4 skin_transform(std::size_t vertex) const {
        glm::dmat4 sum(0.0);
        double total = 0.0;
        for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
            const auto weight = static_cast<double>(primitive_.weights[k]);
            if (weight != 0.0 && primitive_.joints[k] >= place_.joints.size()) {
                file_.fail(primitive_.at + "/attributes/JOINTS_0",
                           fmt::format("expected joints below {}, got {} at vertex {}", place_.joints.size(),
                                       primitive_.joints[k], vertex));
            }
            if (weight != 0.0) sum += weight * place_.joints[primitive_.joints[k]];
            total += weight;
        }
        return total > 0.0 ? sum / total : glm::dmat4(1.0);
    }

    void set_normals(const glm::uvec3& normal, TriangleDescription& triangle) {
        for (int k = 0; k < 3; ++k) {
            if (to_.normals[normal[k]] == glm::vec3(0.0f)) {
                file_.note("normals of no length are ignored", primitive_.at);
                return;
            }
        }
        triangle.normal = normal;
    }

    GltfFile& file_;
    const GltfPrimitive& primitive_;
    const GltfPlace& place_;
    SceneDescription& to_;
    bool is_skinned_;
    std::uint32_t first_vertex_, first_normal_, first_uv_;
};

}  // namespace

void copy_gltf_primitive(GltfFile& file, const GltfPrimitive& primitive, std::uint32_t material,
                         const GltfPlace& place, SceneDescription& to) {
    PrimitiveCopier copier(file, primitive, place, to);
    copier.add_vertices();
    copier.add_triangles(material);
}

}  // namespace pl
