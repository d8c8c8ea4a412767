#include "core/measure/picture_identity.h"

#include <fmt/format.h>

#include "core/base/hash.h"

namespace pl {

std::uint64_t picture_key(const std::string& scene_hash, const RenderSettings& settings) {
    Fnv1a hash;
    hash.add(scene_hash);
    const CameraDescription& camera = settings.camera;
    for (const glm::vec3& v : {camera.eye, camera.target, camera.up})
        for (int i = 0; i < 3; ++i) hash.add(v[i]);
    hash.add(camera.fov_deg);
    if (camera.aperture_radius > 0.0f) {
        hash.add(camera.aperture_radius);
        hash.add(camera.focus_distance);
    }
    if (camera.shift != glm::vec2(0.0f)) {
        hash.add(camera.shift.x);
        hash.add(camera.shift.y);
    }
    if (camera.is_mirrored) hash.add(std::uint64_t{1});
    for (const int number : {settings.width, settings.height, settings.max_depth})
        hash.add(static_cast<std::uint64_t>(number));
    return hash.value();
}

std::string picture_hash(std::uint64_t key) { return fmt::format("{:016x}", key); }

}  // namespace pl
