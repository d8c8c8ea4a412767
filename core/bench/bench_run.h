// One finished run of a bench, and its file: an interrupted bench continues from these.
#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json_file.h"
#include "core/measure/run_recorder.h"

namespace pl::bench {

/// The unit of comparison: runs of the same cell differ in their seeds alone.
struct BenchCell {
    std::string scene;
    std::string method;
    std::string backend;

    auto operator<=>(const BenchCell&) const = default;
    /// "door/reinforcement/cpu"; file_name() is the same with dashes.
    std::string title() const { return scene + "/" + method + "/" + backend; }
    std::string file_name() const { return scene + "-" + method + "-" + backend; }
};

struct BenchRun {
    BenchCell cell;
    std::uint64_t seed = 1;
    bool warm_up = false;  ///< the first of its cell in a process: reported, but left out of summaries
    std::string device;
    int threads = 0;
    std::string commit = "unknown";  ///< of the program that made it
    std::string host{};              ///< that made it, in a job of several processes; else empty
    RunSeries series;

    const RunPoint& end() const { return series.points.back(); }
};

/// Schema "pathlight.run/1", points included.
Json run_json(const BenchRun& run);
/// Throws Json::exception: read_members() turns it into a message.
BenchRun run_from_json(const Json& json);

inline constexpr std::string_view kRunSchema = "pathlight.run/1";

}  // namespace pl::bench
