#include "core/io/write_scene.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/camera_file.h"
#include "core/io/files.h"
#include "core/io/json_file.h"
#include "core/io/kept_meshes.h"
#include "core/io/scene_json.h"
#include "core/io/scene_materials.h"
#include "core/io/texture_file.h"
#include "core/scene/default_light.h"
#include "core/scene/instances.h"
#include "core/scene/surface_info.h"
#include "core/scene/up_axis.h"

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
    write_file_atomic(folder / (stem + ".obj"), obj_text(scene, names, stem));
    write_file_atomic(folder / (stem + ".mtl"), mtl_text(scene, names));
}

namespace fs = std::filesystem;

namespace {

void require_free(const fs::path& path) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(path, ignored)))
        throw Error(ErrorKind::Usage, fmt::format("{}: expected a new name, got one that is taken", path.string()));
}

/// A hidden folder beside its target; removed unless it has become the target.
class HiddenFolder {
public:
    explicit HiddenFolder(fs::path target) : target_(std::move(target)) {
        path_ = target_.parent_path() / fmt::format(".pathlight-{}.parts", ::getpid());
        std::error_code error;
        if (!fs::create_directory(path_, error))
            fail_write(target_, error ? error.message() : path_.string() + " is in the way");
    }
    ~HiddenFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    HiddenFolder(const HiddenFolder&) = delete;
    HiddenFolder& operator=(const HiddenFolder&) = delete;

    const fs::path& path() const { return path_; }
    void become_target() {
        std::error_code error;
        fs::rename(path_, target_, error);
        if (error) fail_write(target_, error.message());
        path_.clear();
    }

private:
    fs::path target_;
    fs::path path_;
};

/// OBJ files hold no instances.
SceneDescription with_copies(const SceneDescription& scene) {
    const std::uint64_t count = shown_triangles(scene);
    if (count > kMostStoredTriangles)
        throw Error(ErrorKind::Input, fmt::format("{}: scene files hold no instances but copies: expected at most {} "
                                                  "triangles with those of all instances, got {}",
                                                  scene.source.string(), kMostStoredTriangles, count));
    SceneDescription copied = scene;
    expand_instances(copied);
    return copied;
}

class SceneWriter {
public:
    /// Images and mesh go to `folder`; the document names them in `shown_folder`, relative to the scene file.
    SceneWriter(const SceneDescription& scene, fs::path folder, std::string shown_folder)
        : scene_(scene), folder_(std::move(folder)), shown_folder_(std::move(shown_folder)) {}

    Json document() {
        const std::vector<std::string> names = material_names(scene_);
        write_mesh(scene_, names, folder_, "mesh");
        Json document{{"schema", "pathlight.scene/1"}, {"name", scene_.name}, {"obj", shown("mesh.obj")}};
        if (!scene_.summary.empty()) document["summary"] = scene_.summary;
        if (!scene_.normals.empty()) document["normals"] = "unit";
        if (!scene_.vertex_colors.empty()) {
            write_vertex_colors(folder_ / "vertex-colors.exr", scene_.vertex_colors);
            document["vertex_colors"] = shown("vertex-colors.exr");
        }
        add_cameras(document);
        add_environment(document);
        for (const PunctualLightDescription& light : scene_.punctual_lights)
            document["lights"].push_back(punctual_light_json(light));
        for (std::size_t i = 0; i < names.size(); ++i)
            document["materials"][names[i]] = material(scene_.materials[i], names);
        add_settings(document);
        return document;
    }

    std::size_t images() const { return images_; }

private:
    std::string shown(const std::string& file) const { return shown_folder_ + "/" + file; }

    /// A chosen one of the listed cameras comes first, which is the one that is shown.
    void add_cameras(Json& document) const {
        if (scene_.chosen_camera == 0) document["camera"] = camera_json(scene_.camera);
        Json list = Json::array();
        for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
            NamedCamera camera = scene_.cameras[i];
            const bool is_chosen = i + 1 == scene_.chosen_camera;
            if (is_chosen) camera.camera = scene_.camera;
            list.insert(is_chosen ? list.begin() : list.end(), named_camera_json(camera));
        }
        if (!list.empty()) document["cameras"] = std::move(list);
    }

    void add_environment(Json& document) {
        Json environment = Json::object();
        if (scene_.environment != glm::vec3(0.0f)) environment["radiance"] = vector_json(scene_.environment);
        if (!scene_.environment_map.texels.empty()) {
            write_environment_map(folder_ / "environment.exr", scene_.environment_map);
            ++images_;
            environment["map"] = shown("environment.exr");
            environment["rotation_deg"] = scene_.environment_map.rotation_deg;
            const glm::mat3& axes = scene_.environment_map.axes;
            if (axes != glm::mat3(1.0f))
                environment["axes"] = Json::array({vector_json(axes[0]), vector_json(axes[1]), vector_json(axes[2])});
        }
        if (scene_.sun.radiance != glm::vec3(0.0f))
            environment["sun"] = {{"direction", vector_json(scene_.sun.direction)},
                                  {"radiance", vector_json(scene_.sun.radiance)},
                                  {"angle_deg", scene_.sun.angle_deg}};
        if (!environment.empty()) document["environment"] = std::move(environment);
    }

    /// `names`: of all materials.
    Json material(const MaterialDescription& from, const std::vector<std::string>& names) {
        Json json = material_json(from);
        if (from.blend.is_any()) json["blend"]["with"] = names[from.blend.other];
        for (const MaterialImage& image : kMaterialImages) add_image(json, image, from.textures.*image.texture);
        if (from.textures.normal != kNoTexture) {
            json["normal_strength"] = from.normal_strength;
            json["normal_green"] = name_of(from.normal_green);
        }
        return json;
    }

    void add_image(Json& json, const MaterialImage& image, std::uint32_t texture) {
        if (texture == kNoTexture) return;
        std::string& file = files_[{texture, image.content}];
        if (file.empty()) {
            file = write_texture(folder_, fmt::format("image-{}", files_.size()), scene_.textures[texture],
                                 image.content);
            ++images_;
        }
        const std::string pointer = fmt::format("/{}", image.name);
        json[Json::json_pointer(pointer)] = shown(file);
        if (!scene_.textures[texture].repeats) json[Json::json_pointer(pointer + "_wrap")] = "clamp";
    }

    /// Values that follow from the chosen camera are left out: they are set again when the scene is opened.
    void add_settings(Json& document) const {
        const float aspect = scene_.chosen_camera > 0 ? scene_.cameras[scene_.chosen_camera - 1].aspect : 0.0f;
        Json settings = Json::object();
        for (const auto& [option, value] : scene_.settings) {
            const bool follows = option == "size" && aspect > 0.0f && value == size_of_aspect(aspect);
            if (!follows && option != "up-axis") settings[option] = value;
        }
        if (nearest_axis(scene_.camera.up) != scene_.up)
            for (const UpAxis axis : {UpAxis::X, UpAxis::Y, UpAxis::Z})
                if (up_direction(axis, scene_) == scene_.up) settings["up-axis"] = name_of(axis);
        if (light_of(scene_) == SceneLight::None) settings["default-light"] = "off";
        if (!settings.empty()) document["settings"] = std::move(settings);
    }

    const SceneDescription& scene_;
    fs::path folder_;
    std::string shown_folder_;
    std::map<std::pair<std::uint32_t, TextureContent>, std::string> files_;
    std::size_t images_ = 0;
};

}  // namespace

SceneParts write_scene(const SceneDescription& scene, const fs::path& path) {
    if (suffix_of(path) != ".json")
        throw Error(ErrorKind::Usage, fmt::format("{}: expected a name that ends with .json", path.string()));
    const fs::path folder = path.parent_path() / (path.stem().string() + "-parts");
    if (!is_utf8(folder.filename().string()))
        throw Error(ErrorKind::Usage, fmt::format("{}: expected a name in UTF-8", path.string()));
    require_free(path);
    require_free(folder);
    const SceneDescription copied = scene.meshes.empty() ? SceneDescription{} : with_copies(scene);
    HiddenFolder parts(folder);
    SceneWriter writer(scene.meshes.empty() ? scene : copied, parts.path(), folder.filename().string());
    const Json document = writer.document();
    parts.become_target();
    try {
        write_json_file(path, document);
    } catch (const Error&) {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        throw;
    }
    return {.folder = folder, .images = writer.images()};
}

}  // namespace pl
