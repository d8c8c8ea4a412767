#include "core/scene/crop.h"

#include <cmath>

namespace pl {

CameraDescription cropped(CameraDescription camera, float width, float height, const CropWindow& window) {
    const glm::vec2 middle(window.x + 0.5f * window.width - 0.5f * width,
                           0.5f * height - (window.y + 0.5f * window.height));
    camera.shift = (camera.shift * height + middle) / window.height;
    if (window.height != height) {
        const double tangent = std::tan(0.5 * glm::radians(static_cast<double>(camera.fov_deg)));
        camera.fov_deg =
            static_cast<float>(glm::degrees(2.0 * std::atan(tangent * static_cast<double>(window.height / height))));
    }
    return camera;
}

}  // namespace pl
