#include "core/bench/gate.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl::bench {
namespace {

std::map<std::string, std::string> picture_hashes(const Json& plan) {
    std::map<std::string, std::string> hashes;
    for (const Json& scene : plan.at("scenes")) hashes[scene.at("name")] = scene.at("picture_hash");
    return hashes;
}

std::vector<double> errors_times_seconds(const CellSummary& cell) {
    std::vector<double> values;
    for (const RunEnd& end : cell.ends) values.push_back(end.error_seconds());
    return values;
}

}  // namespace

std::vector<GateRow> gate_rows(const BenchResults& earlier, const BenchResults& now, double tolerance_percent) {
    auto hashes = picture_hashes(earlier.plan);
    for (const auto& [scene, hash] : picture_hashes(now.plan))
        if (hashes.contains(scene) && hashes.at(scene) != hash)
            throw Error(ErrorKind::Input,
                        fmt::format("--gate: {} has another picture hash than before: scene, camera, size, "
                                    "light or depth have changed",
                                    scene));
    std::vector<GateRow> rows;
    for (const CellSummary& cell : now.summary.cells) {
        const CellSummary* const old = earlier.summary.find(cell.cell);
        if (old == nullptr) continue;
        GateRow row{.cell = cell.cell,
                    .slowdown = ratio_interval(errors_times_seconds(cell), errors_times_seconds(*old))};
        row.failed = old->ends.size() >= kFewestRuns && cell.ends.size() >= kFewestRuns &&
                     row.slowdown.low > 1.0 + 0.01 * tolerance_percent;
        rows.push_back(row);
    }
    if (rows.empty())
        throw Error(ErrorKind::Input,
                    "--gate: the earlier results have no scene, method and back end in common with these");
    return rows;
}

std::string require_gate(const std::vector<GateRow>& rows, double tolerance_percent) {
    std::string text;
    std::string failed;
    for (const GateRow& row : rows) {
        text += fmt::format("gate {}: takes {:.3g} times as long to the same error (95 %: {:.3g} to {:.3g}){}\n",
                            row.cell.title(), row.slowdown.value, row.slowdown.low, row.slowdown.high,
                            row.failed ? ", FAILED" : "");
        if (row.failed) failed += (failed.empty() ? "" : ", ") + row.cell.title();
    }
    if (!failed.empty())
        throw Error(ErrorKind::Threshold,
                    fmt::format("--gate: slower by more than {} %: {}\n{}", tolerance_percent, failed, text));
    return text;
}

}  // namespace pl::bench
