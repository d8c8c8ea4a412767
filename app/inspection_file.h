// The learned hemisphere of a radiance volume, in files.
#pragma once

#include <filesystem>
#include <string>

#include "app/events.h"
#include "app/scene_picture.h"
#include "core/inspect/guiding_figures.h"
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
    bool partial = false;        ///< training was interrupted
    CameraDescription camera{};  ///< decides how discs are turned
    std::optional<LightReport> truth{};
};

/// Members position, normal, volume, bins, side, mean_radiance, bsdf_fraction, and per cell direction, radiance, probability,
/// visits. With a truth also member truth: paths_per_cell, invalid_paths, target_light, table_divergence and mixture_divergence
/// (value, low, high; nats), variance_factor (the same, or null), and per cell radiance, radiance_error, target, product, mixture.
Json inspection_json(const VolumeInspection& volume, const InspectionSource& source);

/// Header "cell,row,column,dx,dy,dz,radiance,probability,visits", then one row per cell; (dx, dy, dz) is the world
/// direction through the cell's middle. With a truth also "true_radiance,true_error,true_target,true_product,mixture".
std::string inspection_csv(const VolumeInspection& volume, const std::optional<LightReport>& truth);

/// The figures of key frames: "passes,table,table_low,table_high,mixture,...,variance,...,divergence_to_end,variation_to_end".
std::string history_csv(const std::vector<HistoryPoint>& points);
/// The same as an array of objects; intervals as in the truth, infinite divergences null.
Json history_json(const std::vector<HistoryPoint>& points);
/// Instead of save_inspection(): JSON {"schema": "pathlight.history/1", ...}, CSV or curves.
void save_history(const std::filesystem::path& path, const std::vector<HistoryPoint>& points,
                  const VolumeInspection& volume, const InspectionSource& source);

/// Paths, divergences and variance factor with their 95 % intervals, as text.
std::vector<std::string> truth_lines(const LightReport& truth);

/// Writes the file whole or not at all. Throws Error: Usage for another suffix, Runtime.
void save_inspection(const std::filesystem::path& path, const VolumeInspection& volume,
                     const InspectionSource& source);

}  // namespace pl
