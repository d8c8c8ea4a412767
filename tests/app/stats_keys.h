// The keys of the statistics file, in their order.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pl::test {

inline const std::vector<std::string> kStatsKeys{"schema",
                                                 "version",
                                                 "scene",
                                                 "scene_hash",
                                                 "light",
                                                 "method",
                                                 "view",
                                                 "backend",
                                                 "device",
                                                 "threads",
                                                 "width",
                                                 "height",
                                                 "spp",
                                                 "seed",
                                                 "max_depth",
                                                 "nee",
                                                 "roulette",
                                                 "seconds",
                                                 "ended_by",
                                                 "target_error",
                                                 "paths",
                                                 "segments",
                                                 "shadow_rays",
                                                 "emission_rays",
                                                 "zero_contribution_paths",
                                                 "mean_path_length",
                                                 "invalid_samples",
                                                 "escaped_paths",
                                                 "diagnostics",
                                                 "mean_radiance",
                                                 "field",
                                                 "guiding",
                                                 "effects_needed",
                                                 "effects_compiled",
                                                 "kernel"};

inline const std::vector<std::string> kSecondsKeys{"load",       "build", "upload", "place",
                                                   "precompute", "learn", "render", "total"};

inline const std::vector<std::string> kFieldKeys{"representation", "volumes", "added_volumes", "bins",
                                                 "bytes",          "passes",  "records",       "lookup_misses"};

inline std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

}  // namespace pl::test
