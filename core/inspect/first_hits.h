// The first surfaces that a camera sees, at the centers of pixels: what a filter of a noisy picture goes by.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// In arrays of one number per pixel, [row][column], for loops over rows.
struct FirstHits {
    int width = 0;
    int height = 0;
    std::vector<float> normal[3];  ///< shading normals
    std::vector<float> albedo[3];  ///< of the diffuse lobe
    std::vector<float> nearness;   ///< 1 over the depth along the camera's axis, linear over the pixels of a plane
    std::vector<float> slope[2];  ///< change of nearness per pixel to the right and down, in the plane of the surface
    std::vector<float> material;  ///< its number; NaN where nothing is hit

    std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Of a pinhole in the place of the camera's lens. Incomplete if `stop` is set meanwhile.
FirstHits find_first_hits(const HostScene& scene, const CameraDescription& camera, int width, int height,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace pl
