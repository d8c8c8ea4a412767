// A walk of paths from the camera through the scene: the points where radiance volumes are of use, and sites among them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/kernel/scene/camera.h"
#include "core/kernel/scene/surface_point.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Points on guided surfaces, on the sides that paths from the camera, a pinhole, arrive at. The paths sample the BSDF, and their
/// length alone ends them. Deterministic in the scene and the camera.
std::vector<SurfacePoint> walk_from_camera(const HostScene& scene, const Camera& camera, int threads = 1);

/// Sites of `count` volumes among the points, each for an equal share of them; all points if they are fewer. Points are parted
/// at the median of a normal's component while their normals are too different for one volume, then of a coordinate; the site of
/// a part is its point nearest to the mean position. Scaling the points by a power of two scales the sites.
std::vector<SurfacePoint> choose_sites(std::vector<SurfacePoint> points, std::size_t count);

}  // namespace pl
