// The learned hemisphere of a radiance volume beside the light that reaches it, as a picture and as text.
#pragma once

#include <string>
#include <vector>

#include "core/inspect/guiding_figures.h"
#include "core/io/image.h"
#include "core/scene/description.h"

namespace pl {

/// Learned beside true radiance, on one scale; below them the density that leaves no variance beside that of guided paths, on one
/// scale, both relative to cosine sampling.
ByteImage draw_truth(const VolumeInspection& volume, const LightReport& truth, const CameraDescription& camera,
                     const std::string& title);

/// Paths, divergences and variance factor with their 95 % intervals.
std::vector<std::string> truth_lines(const LightReport& truth);

}  // namespace pl
