#include "core/io/obj_library.h"

#include <sstream>

#include <tiny_obj_loader.h>

#include "core/base/error.h"
#include "core/io/name_index.h"
#include "core/io/obj_check.h"

namespace pl {

namespace {

/// Collected by the callbacks of the library.
struct LibraryReading {
    explicit LibraryReading(const CheckedObj& checked_obj) : checked(checked_obj) {}

    const CheckedObj& checked;
    std::vector<glm::vec3> positions{};
    std::vector<glm::vec3> normals{};
    std::vector<glm::vec2> uvs{};
    ObjFaces faces{};
    std::vector<std::string> material_names{};
    NameIndex name_index{};
    std::uint32_t material = ObjFaces::kNoMaterial;
};

LibraryReading& reading(void* user_data) { return *static_cast<LibraryReading*>(user_data); }

void on_vertex(void* user_data, float x, float y, float z, float) {
    reading(user_data).positions.emplace_back(x, y, z);
}

void on_normal(void* user_data, float x, float y, float z) { reading(user_data).normals.emplace_back(x, y, z); }

void on_texture_point(void* user_data, float u, float v, float) { reading(user_data).uvs.emplace_back(u, v); }

void on_material(void* user_data, const char* word, int) {
    LibraryReading& to = reading(user_data);
    const std::string name = decode_name(word);
    to.material = to.name_index.find_or(name, [&] { to.material_names.push_back(name); });
}

/// Indices as in the file: absolute, from 1, 0 for none. check_obj() has checked them.
void on_face(void* user_data, tinyobj::index_t* indices, int count) {
    LibraryReading& to = reading(user_data);
    const std::size_t face = to.faces.size();
    const bool is_known = face < to.checked.face_groups.size();
    const std::uint32_t group = is_known ? to.checked.face_groups[face] : 0;
    const Smoothing smoothing = is_known ? to.checked.face_smoothing[face] : Smoothing::Off;
    const ObjFaces::Run* const last = to.faces.runs.empty() ? nullptr : &to.faces.runs.back();
    if (last == nullptr || last->material != to.material || last->group != group || last->smoothing != smoothing) {
        to.faces.runs.push_back({face, to.material, group, smoothing});
    }
    to.faces.corner_counts.push_back(static_cast<std::uint32_t>(count));
    for (int i = 0; i < count; ++i) {
        // 0 - 1 wraps around to kNone.
        to.faces.corners.push_back({static_cast<std::uint32_t>(indices[i].vertex_index) - 1u,
                                    static_cast<std::uint32_t>(indices[i].normal_index) - 1u,
                                    static_cast<std::uint32_t>(indices[i].texcoord_index) - 1u});
    }
}

LibraryReading parse(CheckedObj& checked) {
    LibraryReading result(checked);
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = on_vertex;
    callbacks.normal_cb = on_normal;
    callbacks.texcoord_cb = on_texture_point;
    callbacks.usemtl_cb = on_material;
    callbacks.index_cb = on_face;
    result.faces.corner_counts.reserve(checked.face_lines.size());
    std::istringstream stream(std::move(checked.text));
    std::string errors;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, &result, nullptr, nullptr, &errors) ||
        result.faces.size() != checked.face_lines.size()) {
        throw Error(ErrorKind::Runtime, "the OBJ library did not read a checked text: " + errors);
    }
    return result;
}

}  // namespace

ObjMesh read_any_obj(std::string_view text, const std::filesystem::path& path) {
    CheckedObj checked = check_obj(text, path);
    LibraryReading reading = parse(checked);
    reading.faces.lines = std::move(checked.face_lines);
    ObjMesh mesh{.positions = std::move(reading.positions),
                 .normals = std::move(reading.normals),
                 .uvs = std::move(reading.uvs),
                 .parts = {},
                 .materials = {},
                 .groups = std::move(checked.group_names),
                 .libraries = std::move(checked.libraries),
                 .warnings = std::move(checked.warnings)};
    mesh.parts.push_back(std::move(reading.faces));
    for (const std::string& name : reading.material_names) {
        mesh.materials.push_back({name, checked.material_lines.at(name)});
    }
    return mesh;
}

}  // namespace pl
