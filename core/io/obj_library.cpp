#include "core/io/obj_library.h"

#include <span>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
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
    std::size_t faces_read = 0;
    Tally unusable_faces{};
    Tally unusable_corners{};
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

/// The first fault of a face's indices of a kind, or an empty text. `index_of` gives that of a corner: absolute, from 1, 0 for none.
template <class IndexOf>
std::string first_fault(const CheckedElements& kind, std::span<const tinyobj::index_t> corners, IndexOf&& index_of) {
    for (const tinyobj::index_t& corner : corners) {
        std::string fault = index_of(corner) > 0 ? kind.fault_of(index_of(corner)) : std::string();
        if (!fault.empty()) return fault;
    }
    return {};
}

/// Adds a face with its indices as in the text.
void add_face(LibraryReading& to, std::span<const tinyobj::index_t> corners, const ObjFaces::Run& run, int line) {
    const auto vertex = [](const tinyobj::index_t& corner) { return corner.vertex_index; };
    const auto normal = [](const tinyobj::index_t& corner) { return corner.normal_index; };
    const auto uv = [](const tinyobj::index_t& corner) { return corner.texcoord_index; };
    if (const std::string fault = first_fault(to.checked.vertices, corners, vertex); !fault.empty()) {
        to.unusable_faces.add(line, [&] { return fault; });
        return;
    }
    const std::string normal_fault = first_fault(to.checked.normals, corners, normal);
    const std::string uv_fault = first_fault(to.checked.texture_points, corners, uv);
    if (!normal_fault.empty() || !uv_fault.empty()) {
        to.unusable_corners.add(line, [&] { return normal_fault.empty() ? uv_fault : normal_fault; });
    }
    const ObjFaces::Run* const last = to.faces.runs.empty() ? nullptr : &to.faces.runs.back();
    if (last == nullptr || last->material != run.material || last->group != run.group ||
        last->smoothing != run.smoothing) {
        to.faces.runs.push_back(run);
    }
    to.faces.corner_counts.push_back(static_cast<std::uint32_t>(corners.size()));
    to.faces.lines.push_back(line);
    for (const tinyobj::index_t& corner : corners) {
        // 0 - 1 wraps around to kNone.
        to.faces.corners.push_back({static_cast<std::uint32_t>(vertex(corner)) - 1u,
                                    static_cast<std::uint32_t>(normal_fault.empty() ? normal(corner) : 0) - 1u,
                                    static_cast<std::uint32_t>(uv_fault.empty() ? uv(corner) : 0) - 1u});
    }
}

void on_face(void* user_data, tinyobj::index_t* indices, int count) {
    LibraryReading& to = reading(user_data);
    const std::size_t face = to.faces_read++;
    if (face >= to.checked.face_lines.size()) return;  // parse() refuses it
    add_face(to, {indices, static_cast<std::size_t>(count)},
             {to.faces.size(), to.material, to.checked.face_groups[face], to.checked.face_smoothing[face]},
             to.checked.face_lines[face]);
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
        result.faces_read != checked.face_lines.size()) {
        throw Error(ErrorKind::Runtime, "the OBJ library did not read a checked text: " + errors);
    }
    return result;
}

}  // namespace

ObjMesh read_any_obj(std::string_view text, const std::filesystem::path& path, const glm::dvec3& origin) {
    CheckedObj checked = check_obj(text, path, origin);
    LibraryReading reading = parse(checked);
    reading.unusable_faces.tell(checked.warnings, path, "this face is left out");
    reading.unusable_corners.tell(checked.warnings, path, "this face is shown without its normals or texture points");
    if (reading.faces.size() == 0) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: no faces: expected at least one 'f' statement with three usable corners, got {} "
                                "vertices and {} faces that cannot be used{}{}",
                                path.string(), checked.vertices.count,
                                reading.unusable_faces.count + checked.short_faces.count,
                                checked.warnings.empty() ? "" : "; ", fmt::join(checked.warnings, "; ")));
    }
    ObjMesh mesh{.origin = origin,
                 .positions = std::move(reading.positions),
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
