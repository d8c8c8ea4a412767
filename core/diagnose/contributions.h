// The parts of a path's radiance: the technique that found each, its bounces, and its light.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/diagnose/path_record.h"

namespace pl::diagnose {

/// The technique that found the light of a contribution.
enum class FoundBy : std::uint32_t {
    Camera,         ///< the camera ray met it
    LightSampling,  ///< a light sample
    Bsdf,           ///< a direction sampled by the BSDF without its delta lobes
    Field,          ///< a direction sampled by the guiding field
    Delta,          ///< a direction of a delta lobe
};
inline constexpr std::size_t kFoundByCount = 5;

struct FoundByInfo {
    FoundBy id;
    std::string_view name;   ///< in files
    std::string_view label;  ///< on screen
};
const std::array<FoundByInfo, kFoundByCount>& all_found_by();

struct Contribution {
    FoundBy found_by = FoundBy::Camera;
    std::uint32_t bounces = 0;  ///< scattering events between the light and the camera: 0 if it is seen directly
    bool is_distant = false;    ///< of the environment or a sun, not of a surface
    double light = 0.0;         ///< luminance brought to the pixel
};

/// All that are not black. Their sum is the luminance of PathRecord::radiance, but for rounding.
std::vector<Contribution> contributions_of(const PathRecord& path);

}  // namespace pl::diagnose
