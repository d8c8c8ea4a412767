#include "core/io/obj.h"

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/obj_check.h"
#include "core/io/obj_materials.h"
#include "core/io/tally.h"
#include "core/io/triangulate.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kNoMaterial = 0xffffffffu;

/// The polygons of a file, collected from the callbacks of the OBJ library.
struct Polygons {
    struct Corner {
        std::uint32_t vertex;
        std::uint32_t normal;  ///< or TriangleDescription::kNoNormal
        std::uint32_t uv;      ///< or TriangleDescription::kNoUv
    };
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<Corner> corners;
    std::vector<std::size_t> first_corner;  ///< per polygon
    std::vector<std::uint32_t> material;    ///< per polygon: index into `material_names`, or kNoMaterial
    std::vector<std::string> material_names;
    std::map<std::string, std::uint32_t> name_index{};
    std::uint32_t current = kNoMaterial;
};

Polygons& polygons(void* user_data) { return *static_cast<Polygons*>(user_data); }

void on_vertex(void* user_data, float x, float y, float z, float) {
    polygons(user_data).positions.emplace_back(x, y, z);
}

void on_normal(void* user_data, float x, float y, float z) { polygons(user_data).normals.emplace_back(x, y, z); }

void on_texture_point(void* user_data, float u, float v, float) { polygons(user_data).uvs.emplace_back(u, v); }

void on_material(void* user_data, const char* word, int) {
    Polygons& to = polygons(user_data);
    const std::string name = decode_name(word);
    const auto next = static_cast<std::uint32_t>(to.material_names.size());
    const auto [entry, is_new] = to.name_index.try_emplace(name, next);
    if (is_new) {
        to.material_names.push_back(name);
    }
    to.current = entry->second;
}

/// Indices as in the file: absolute, from 1, 0 for none. check_obj() has checked them.
void on_face(void* user_data, tinyobj::index_t* indices, int count) {
    Polygons& to = polygons(user_data);
    to.first_corner.push_back(to.corners.size());
    to.material.push_back(to.current);
    for (int i = 0; i < count; ++i) {
        // 0 - 1 wraps around to kNoNormal and kNoUv.
        to.corners.push_back({static_cast<std::uint32_t>(indices[i].vertex_index) - 1u,
                              static_cast<std::uint32_t>(indices[i].normal_index) - 1u,
                              static_cast<std::uint32_t>(indices[i].texcoord_index) - 1u});
    }
}

Polygons parse(std::string clean_text, std::size_t face_count) {
    Polygons result;
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = on_vertex;
    callbacks.normal_cb = on_normal;
    callbacks.texcoord_cb = on_texture_point;
    callbacks.usemtl_cb = on_material;
    callbacks.index_cb = on_face;
    result.first_corner.reserve(face_count + 1);
    result.material.reserve(face_count);
    std::istringstream stream(std::move(clean_text));
    std::string errors;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, &result, nullptr, nullptr, &errors) ||
        result.first_corner.size() != face_count) {
        throw Error(ErrorKind::Runtime, "the OBJ library did not read a checked text: " + errors);
    }
    result.first_corner.push_back(result.corners.size());
    return result;
}

/// Fills the scene from polygons.
class MeshBuilder {
public:
    MeshBuilder(SceneDescription& scene, Polygons input, const CheckedObj& checked, MeshGroups* groups)
        : scene_(scene), in_(std::move(input)), face_lines_(checked.face_lines), face_groups_(checked.face_groups),
          groups_(groups) {
        scene_.positions = std::move(in_.positions);
        scene_.uvs = std::move(in_.uvs);
        scene_.triangles.reserve(in_.corners.size() - 2 * face_lines_.size());
        set_normals();
    }

    void add_triangles(const MaterialTable& table) {
        std::vector<glm::vec3> outline;
        for (std::size_t face = 0; face < face_lines_.size(); ++face) {
            const std::size_t first = in_.first_corner[face];
            const std::size_t count = in_.first_corner[face + 1] - first;
            const std::uint32_t name = in_.material[face];
            const std::uint32_t material = name == kNoMaterial ? table.fallback : table.of_name[name];
            outline.clear();
            for (std::size_t i = 0; i < count; ++i) {
                outline.push_back(scene_.positions[in_.corners[first + i].vertex]);
            }
            const Triangulation cut = triangulate(outline);
            if (!cut.exact) {
                crossed_.add(face_lines_[face]);
            }
            for (const auto& [a, b, c] : cut.triangles) {
                add_triangle({in_.corners[first + a], in_.corners[first + b], in_.corners[first + c]}, material,
                             face);
            }
        }
    }

    void warn(const fs::path& path) {
        std::vector<std::string>& to = scene_.warnings;
        crossed_.tell(to, path, "face whose outline crosses itself or has no area, cut as a fan");
        no_area_.tell(to, path, "triangle without area removed");
        no_normal_.tell(to, path, "normals ignored: not given, or of no length, at one of a triangle's corners");
    }

private:
    void set_normals() {
        scene_.normals.reserve(in_.normals.size());
        for (const glm::vec3& normal : in_.normals) {
            const double length = glm::length(glm::dvec3(normal));
            scene_.normals.push_back(length > 0.0 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0.0f));
        }
    }

    void add_triangle(const std::array<Polygons::Corner, 3>& corners, std::uint32_t material, std::size_t face) {
        TriangleDescription triangle;
        int normals = 0;
        int usable = 0;
        bool has_uvs = true;
        for (int i = 0; i < 3; ++i) {
            const Polygons::Corner& corner = corners[static_cast<std::size_t>(i)];
            triangle.vertex[i] = corner.vertex;
            triangle.normal[i] = corner.normal;
            triangle.uv[i] = corner.uv;
            has_uvs = has_uvs && corner.uv != TriangleDescription::kNoUv;
            const bool given = corner.normal != TriangleDescription::kNoNormal;
            normals += given ? 1 : 0;
            usable += given && scene_.normals[corner.normal] != glm::vec3(0.0f) ? 1 : 0;
        }
        if (!has_area(triangle)) {
            no_area_.add(face_lines_[face]);
            return;
        }
        if (normals > 0 && usable < 3) {
            no_normal_.add(face_lines_[face]);
        }
        if (usable < 3) {
            triangle.normal = glm::uvec3(TriangleDescription::kNoNormal);
        }
        if (!has_uvs) {
            triangle.uv = glm::uvec3(TriangleDescription::kNoUv);
        }
        triangle.material = material;
        scene_.triangles.push_back(triangle);
        if (groups_ != nullptr) {
            groups_->of_triangle.push_back(face_groups_[face]);
        }
    }

    /// Whether a unit normal can be computed in floats: the squared length of the cross product is a normal float.
    bool has_area(const TriangleDescription& t) const {
        const glm::dvec3 a(scene_.positions[t.vertex.x]);
        const glm::dvec3 n =
            glm::cross(glm::dvec3(scene_.positions[t.vertex.y]) - a, glm::dvec3(scene_.positions[t.vertex.z]) - a);
        return glm::dot(n, n) >= static_cast<double>(std::numeric_limits<float>::min());
    }

    SceneDescription& scene_;
    Polygons in_;
    const std::vector<int>& face_lines_;
    const std::vector<std::uint32_t>& face_groups_;
    MeshGroups* groups_;
    Tally crossed_;
    Tally no_area_;
    Tally no_normal_;
};

}  // namespace

SceneDescription load_obj(const fs::path& path, MeshGroups* groups) {
    CheckedObj checked = check_obj(read_text_file(path), path);
    SceneDescription scene;
    scene.source = path;
    scene.files = {path};
    scene.warnings = std::move(checked.warnings);

    Polygons input = parse(std::move(checked.text), checked.face_lines.size());
    std::vector<std::size_t> faces_of(input.material_names.size() + 1, 0);
    for (const std::uint32_t name : input.material) {
        ++faces_of[name == kNoMaterial ? input.material_names.size() : name];
    }
    const MaterialTable table = load_materials(scene, path, checked, input.material_names, faces_of);

    if (groups != nullptr) {
        *groups = {.names = checked.group_names};
    }
    MeshBuilder builder(scene, std::move(input), checked, groups);
    builder.add_triangles(table);
    builder.warn(path);
    if (scene.triangles.empty()) {
        throw Error(ErrorKind::Input, fmt::format("{}: no face has an area", path.string()));
    }
    return scene;
}

}  // namespace pl
