#include "core/io/write_mesh.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/json_file.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

bool is_plain(char c) {
    const auto code = static_cast<unsigned char>(c);
    return code > 0x20 && code != 0x7f && c != '#' && c != '\\';
}

std::string plain_name(const std::string& name) {
    const bool keeps_bytes = is_utf8(name);
    std::string plain;
    for (const char c : name) {
        const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
        const bool follows_word = !plain.empty() && plain.back() != ' ';
        if (c == ' ' && follows_word)
            plain += ' ';
        else
            plain += is_plain(c) && (is_ascii || keeps_bytes) ? c : '_';
    }
    if (plain.empty()) return "material";
    if (plain.back() == ' ') plain.back() = '_';
    return plain;
}

/// Nine digits tell floats apart.
void add_numbers(std::string& text, const char* keyword, const float* numbers, int count) {
    text += keyword;
    for (int i = 0; i < count; ++i) fmt::format_to(std::back_inserter(text), " {:.9g}", numbers[i]);
    text += '\n';
}

void add_corner(std::string& text, const TriangleDescription& triangle, int k) {
    const auto to = std::back_inserter(text);
    const bool has_uv = triangle.uv[k] != TriangleDescription::kNoUv;
    const bool has_normal = triangle.normal[k] != TriangleDescription::kNoNormal;
    fmt::format_to(to, " {}", triangle.vertex[k] + 1);
    if (has_uv || has_normal) text += '/';
    if (has_uv) fmt::format_to(to, "{}", triangle.uv[k] + 1);
    if (has_normal) fmt::format_to(to, "/{}", triangle.normal[k] + 1);
}

std::string obj_text(const SceneDescription& scene, const std::vector<std::string>& names, const std::string& stem) {
    std::string text = fmt::format("mtllib {}.mtl\n", stem);
    for (const glm::vec3& p : scene.positions) add_numbers(text, "v", &p.x, 3);
    for (const glm::vec2& uv : scene.uvs) add_numbers(text, "vt", &uv.x, 2);
    for (const glm::vec3& n : scene.normals) add_numbers(text, "vn", &n.x, 3);
    const TriangleDescription* last = nullptr;
    for (const TriangleDescription& triangle : scene.triangles) {
        if (last == nullptr || last->material != triangle.material)
            text += "usemtl " + names[triangle.material] + "\n";
        last = &triangle;
        text += 'f';
        for (int k = 0; k < 3; ++k) add_corner(text, triangle, k);
        text += '\n';
    }
    return text;
}

std::string mtl_text(const SceneDescription& scene, const std::vector<std::string>& names) {
    std::string text = "# Colors alone: the scene file has the surfaces.\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += "newmtl " + names[i] + "\n";
        const MaterialDescription& material = scene.materials[i];
        const glm::vec3& color = material.*surface_info(material.kind).color;
        add_numbers(text, "Kd", &color.x, 3);
    }
    return text;
}

}  // namespace

std::vector<std::string> material_names(const SceneDescription& scene) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const MaterialDescription& material : scene.materials) {
        const std::string plain = plain_name(material.name);
        std::string name = plain;
        for (int number = 2; !taken.insert(name).second; ++number) name = fmt::format("{} ({})", plain, number);
        names.push_back(std::move(name));
    }
    return names;
}

void write_mesh(const SceneDescription& scene, const std::vector<std::string>& names,
                const std::filesystem::path& folder, const std::string& stem) {
    write_text_file_atomic(folder / (stem + ".obj"), obj_text(scene, names, stem));
    write_text_file_atomic(folder / (stem + ".mtl"), mtl_text(scene, names));
}

}  // namespace pl
