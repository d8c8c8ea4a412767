// Pictures of any renderer as the runs of a bench: what they are is told by a file beside them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/bench/bench_results.h"

namespace pl::bench {

inline constexpr std::string_view kScoreFile = "score.json";
inline constexpr const char* kScoreSchema = "pathlight.score/1";

struct ScoredPictures {
    BenchResults results;
    std::vector<std::string> warnings{};
};

/// Measures the linear pictures that score.json of the folder names, in `threads`, and writes what report needs of them into it, but
/// not the results. Pictures of one scene, method, backend and seed are the points of one run, by their samples. Throws Error(Input)
/// that names file and line: unknown members, missing ones, pictures that are missing, of another size than their reference, or
/// twice the same; times that do not grow with the samples.
ScoredPictures score_pictures(const BenchFolder& folder, int threads);

}  // namespace pl::bench
