// Cameras in JSON: parts of one camera for --camera, or the cameras of a path in their order.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/json_document.h"
#include "core/io/json_file.h"
#include "core/scene/camera_path.h"
#include "core/scene/description.h"

namespace pl {

/// The given parts of a camera; the other parts come from elsewhere.
struct CameraChoice {
    std::optional<glm::vec3> eye;
    std::optional<glm::vec3> target;
    std::optional<glm::vec3> up;
    std::optional<float> fov_deg;
    std::optional<float> aperture_radius;
    std::optional<float> focus_distance;
    std::optional<float> shift_x;
    std::optional<float> shift_y;
    std::optional<bool> is_mirrored;
};

/// The camera with the given parts replaced.
CameraDescription replaced(CameraDescription camera, const CameraChoice& choice);

/// {"eye": [x,y,z], "target": [x,y,z], "up": [x,y,z], "fov_deg": vertical, "aperture_radius": r, "focus_distance": d}, and
/// "shift_x" and "shift_y" if the picture is shifted: in its heights, right and up, and "mirrored": true if right and left are swapped.
Json camera_json(const CameraDescription& camera);

/// Replaces the parts of a camera that the object at `pointer` has, whose members are those of camera_json(). Throws Error(Input) with
/// file and line.
void read_camera_parts(const JsonDocument& file, const std::string& pointer, CameraChoice& camera);
/// `standard` with these parts of the object at `pointer`. Throws Error(Input) with file and line for a camera that looks nowhere.
CameraDescription whole_camera(const JsonDocument& file, const std::string& pointer,
                               const CameraDescription& standard, const CameraChoice& given);

inline constexpr const char* kCamerasSchema = "pathlight.cameras/1";

/// Reads {"schema": kCamerasSchema, "cameras": [camera_json(), ...]}; members that a camera lacks come from
/// `standard`. Throws Error(Input) with file and line.
std::vector<CameraDescription> load_cameras(const std::filesystem::path& path, const CameraDescription& standard);

/// The path through the cameras of a file. Throws Error(Input) with file and line, also for fewer than CameraPath::kFewest.
CameraPath load_camera_path(const std::filesystem::path& path, const CameraDescription& standard);

/// The member "cameras" of a scene file: [camera_json() with "name" and "aspect", ...], each of which may be missing;
/// missing members of a camera come from `standard`. Throws Error(Input) with file and line.
std::vector<NamedCamera> read_named_cameras(const JsonDocument& file, const CameraDescription& standard);

/// For read_named_cameras().
Json named_camera_json(const NamedCamera& camera);

/// Writes a file for load_cameras(), which reads the same bits. Throws Error(Runtime).
void save_cameras(const std::filesystem::path& path, std::span<const CameraDescription> cameras);

// The cameras that a file lists, and the choice among them.

/// Value of the setting `size` for pictures of this width over height.
std::string size_of_aspect(float aspect);

/// The first listed camera, or the camera of frame_camera() if none is listed. Expects SceneDescription::up and a
/// triangle.
void set_default_camera(SceneDescription& scene);

/// Sets the camera that is asked for by name or number; if nothing is asked, the camera stays. The shape of the picture of a listed
/// camera becomes the setting `size`, unless the scene has one.
/// Throws Error(Usage) if there is no such camera.
void choose_camera(const std::string& asked, SceneDescription& scene);

}  // namespace pl
