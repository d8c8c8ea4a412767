// The learned hemisphere of a radiance volume, in files.
#pragma once

#include <filesystem>
#include <string>

#include "app/events.h"
#include "core/io/image.h"
#include "core/session/snapshot.h"

namespace pl {

enum class InspectionKind { AsJson, AsCsv, AsPng };

/// Kind by suffix. Throws Error(Usage) with the known suffixes.
InspectionKind inspection_kind(const std::filesystem::path& path);

/// Origin of the numbers.
struct InspectionSource {
    std::string scene;
    std::string scene_hash;
    std::string method;
    std::uint32_t spp = 0;
    std::uint64_t seed = 0;
    bool partial = false;  ///< training was interrupted
};

/// Members position, normal, volume, bins, side, mean_radiance, and per cell direction, radiance, probability, visits.
Json inspection_json(const VolumeInspection& volume, const InspectionSource& source);

/// Header "cell,row,column,dx,dy,dz,radiance,probability,visits", then one row per cell; (dx, dy, dz) is the world
/// direction through the cell's middle.
std::string inspection_csv(const VolumeInspection& volume);

/// Writes the file whole or not at all. Throws Error: Usage for another suffix, Runtime.
void save_inspection(const std::filesystem::path& path, const VolumeInspection& volume,
                     const InspectionSource& source);

}  // namespace pl
