#include "core/io/camera_file.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/frame_camera.h"

namespace pl {

namespace {

/// As read_camera_parts(); the object may have members of `others`, too.
void read_parts(const JsonDocument& file, const std::string& pointer, CameraChoice& camera,
                const std::vector<std::string>& others = {}) {
    std::vector<std::string> known{"eye",     "target",  "up",      "fov_deg", "aperture_radius", "focus_distance",
                                   "shift_x", "shift_y", "mirrored"};
    known.insert(known.end(), others.begin(), others.end());
    if (file.object(pointer, known) == nullptr) file.fail(pointer, "expected a camera { ... }");
    const auto replace = [](auto& part, const auto& given) {
        if (given) part = given;
    };
    replace(camera.eye, file.point(pointer + "/eye"));
    replace(camera.target, file.point(pointer + "/target"));
    replace(camera.up, file.vector(pointer + "/up"));
    replace(camera.fov_deg, file.number(pointer + "/fov_deg"));
    replace(camera.aperture_radius, file.number(pointer + "/aperture_radius"));
    replace(camera.focus_distance, file.number(pointer + "/focus_distance"));
    replace(camera.shift_x, file.number(pointer + "/shift_x"));
    replace(camera.shift_y, file.number(pointer + "/shift_y"));
    replace(camera.is_mirrored, file.boolean(pointer + "/mirrored"));
    if (camera.fov_deg && !(*camera.fov_deg > 0.0f && *camera.fov_deg < 180.0f))
        file.fail(pointer + "/fov_deg", "expected an angle between 0 and 180 degrees");
    if (camera.aperture_radius && !(*camera.aperture_radius >= 0.0f))
        file.fail(pointer + "/aperture_radius", "expected a number of at least 0");
    if (camera.focus_distance && !(*camera.focus_distance > 0.0f))
        file.fail(pointer + "/focus_distance", "expected a number above 0");
}

/// read_parts() over `standard`. Throws Error(Input), also for a camera that looks nowhere.
CameraDescription read_whole_camera(const JsonDocument& file, const std::string& pointer,
                                    const CameraDescription& standard, const std::vector<std::string>& others = {}) {
    CameraChoice given;
    read_parts(file, pointer, given, others);
    return whole_camera(file, pointer, standard, given);
}

/// All cameras of a file; missing members come from `standard`. Throws Error(Input).
std::vector<CameraDescription> read_cameras(const JsonDocument& file, const CameraDescription& standard) {
    file.object("", {"schema", "cameras"});
    file.require_schema(kCamerasSchema);
    std::vector<CameraDescription> cameras;
    for (std::size_t i = 0; i < file.array_size("/cameras"); ++i)
        cameras.push_back(read_whole_camera(file, fmt::format("/cameras/{}", i), standard));
    return cameras;
}

}  // namespace

CameraDescription whole_camera(const JsonDocument& file, const std::string& pointer,
                               const CameraDescription& standard, const CameraChoice& given) {
    const CameraDescription camera = replaced(standard, given);
    if (camera.eye == camera.target)
        file.fail(pointer + "/eye", "expected an eye away from the target, got the same point for both");
    if (camera.up == glm::vec3(0.0f)) file.fail(pointer + "/up", "expected a direction, got [0, 0, 0]");
    return camera;
}

CameraDescription replaced(CameraDescription camera, const CameraChoice& choice) {
    camera.eye = choice.eye.value_or(camera.eye);
    camera.target = choice.target.value_or(camera.target);
    camera.up = choice.up.value_or(camera.up);
    camera.fov_deg = choice.fov_deg.value_or(camera.fov_deg);
    camera.aperture_radius = choice.aperture_radius.value_or(camera.aperture_radius);
    camera.focus_distance = choice.focus_distance.value_or(camera.focus_distance);
    camera.shift = {choice.shift_x.value_or(camera.shift.x), choice.shift_y.value_or(camera.shift.y)};
    camera.is_mirrored = choice.is_mirrored.value_or(camera.is_mirrored);
    return camera;
}

Json camera_json(const CameraDescription& camera) {
    Json json{{"eye", vector_json(camera.eye)},
              {"target", vector_json(camera.target)},
              {"up", vector_json(camera.up)},
              {"fov_deg", camera.fov_deg},
              {"aperture_radius", camera.aperture_radius},
              {"focus_distance", camera.focus_distance}};
    if (camera.shift != glm::vec2(0.0f)) json.update({{"shift_x", camera.shift.x}, {"shift_y", camera.shift.y}});
    if (camera.is_mirrored) json["mirrored"] = true;
    return json;
}

void read_camera_parts(const JsonDocument& file, const std::string& pointer, CameraChoice& camera) {
    read_parts(file, pointer, camera);
}

std::vector<CameraDescription> load_cameras(const std::filesystem::path& path, const CameraDescription& standard) {
    return read_cameras(JsonDocument(read_text_file(path), path), standard);
}

CameraPath load_camera_path(const std::filesystem::path& path, const CameraDescription& standard) {
    const JsonDocument file(read_text_file(path), path);
    std::vector<CameraDescription> cameras = read_cameras(file, standard);
    if (cameras.size() < CameraPath::kFewest)
        file.fail("/cameras",
                  fmt::format("expected at least {} cameras, got {}", CameraPath::kFewest, cameras.size()));
    return CameraPath(std::move(cameras));
}

std::vector<NamedCamera> read_named_cameras(const JsonDocument& file, const CameraDescription& standard) {
    std::vector<NamedCamera> cameras;
    for (std::size_t i = 0; i < file.array_size("/cameras"); ++i) {
        const std::string at = fmt::format("/cameras/{}", i);
        const CameraDescription camera = read_whole_camera(file, at, standard, {"name", "aspect"});
        const float aspect = file.number(at + "/aspect").value_or(0.0f);
        if (!(aspect >= 0.0f)) file.fail(at + "/aspect", "expected width over height of the picture, or 0 for any");
        cameras.push_back({.name = file.text(at + "/name").value_or(fmt::format("camera {}", i + 1)),
                           .camera = camera,
                           .aspect = aspect});
    }
    return cameras;
}

Json named_camera_json(const NamedCamera& camera) {
    Json json{{"name", camera.name}};
    json.update(camera_json(camera.camera));
    if (camera.aspect > 0.0f) json["aspect"] = camera.aspect;
    return json;
}

void save_cameras(const std::filesystem::path& path, std::span<const CameraDescription> cameras) {
    Json list = Json::array();
    for (const CameraDescription& camera : cameras) list.push_back(camera_json(camera));
    write_json_file(path, {{"schema", kCamerasSchema}, {"cameras", std::move(list)}});
}

namespace {

void use(std::size_t index, SceneDescription& scene) {
    scene.camera = scene.cameras[index].camera;
    scene.chosen_camera = static_cast<std::uint32_t>(index + 1);
}

std::string camera_names(const SceneDescription& scene) {
    std::vector<std::string> names;
    for (const NamedCamera& camera : scene.cameras)
        names.push_back(fmt::format("{} '{}'", names.size() + 1, camera.name));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// Index of a camera by its name, else by its number from 1.
std::size_t find_camera(const std::string& asked, const SceneDescription& scene) {
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (scene.cameras[i].name == asked) return i;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (std::to_string(i + 1) == asked) return i;
    throw Error(
        ErrorKind::Usage,
        fmt::format("--camera {}: expected a camera .json file, or one of the cameras that {} lists, got none of "
                    "them: {}",
                    asked, scene.source.string(), camera_names(scene)));
}

}  // namespace

std::string size_of_aspect(float aspect) {
    constexpr float kHeight = 512.0f;
    return fmt::format("{:.0f}x{:.0f}", kHeight * std::clamp(aspect, 0.25f, 4.0f), kHeight);
}

void set_default_camera(SceneDescription& scene) {
    if (scene.cameras.empty())
        scene.camera = frame_camera(scene);
    else
        use(0, scene);
}

void choose_camera(const std::string& asked, SceneDescription& scene) {
    if (!asked.empty()) use(find_camera(asked, scene), scene);
    const float aspect = scene.chosen_camera > 0 ? scene.cameras[scene.chosen_camera - 1].aspect : 0.0f;
    if (aspect > 0.0f && scene.setting("size").empty()) scene.settings.emplace_back("size", size_of_aspect(aspect));
}

}  // namespace pl
