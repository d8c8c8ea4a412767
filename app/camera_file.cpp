#include "app/camera_file.h"

#include "core/io/files.h"
#include "core/io/json_document.h"

namespace pl {

CameraChoice load_camera_file(const std::filesystem::path& path) {
    const JsonDocument file(read_text_file(path), path);
    file.object("", {"eye", "target", "up", "fov_deg", "aperture_radius", "focus_distance"});
    const CameraChoice camera{.eye = file.vector("/eye"),
                              .target = file.vector("/target"),
                              .up = file.vector("/up"),
                              .fov_deg = file.number("/fov_deg"),
                              .aperture_radius = file.number("/aperture_radius"),
                              .focus_distance = file.number("/focus_distance")};
    if (camera.fov_deg && !(*camera.fov_deg > 0.0f && *camera.fov_deg < 180.0f))
        file.fail("/fov_deg", "expected an angle between 0 and 180 degrees");
    if (camera.aperture_radius && !(*camera.aperture_radius >= 0.0f))
        file.fail("/aperture_radius", "expected a number of at least 0");
    if (camera.focus_distance && !(*camera.focus_distance > 0.0f))
        file.fail("/focus_distance", "expected a number above 0");
    return camera;
}

}  // namespace pl
