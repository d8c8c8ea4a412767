#include "core/diagnose/diagnostics.h"

#include <algorithm>

#include <fmt/format.h>

namespace pl::diagnose {
namespace {

constexpr std::array<DiagnosticInfo, kDiagnosticCount> kDiagnostics{
    DiagnosticInfo{DiagnosticKind::InvalidSample, "invalid_samples", "invalid",
                   "Samples that were NaN, infinite or negative: left out of the picture.", kInvalidPixel},
    DiagnosticInfo{DiagnosticKind::EscapedPath, "escaped_paths", "escaped",
                   "Paths that left although closed surfaces surround the camera: they slipped through a crack.",
                   0xff00ffffu},
    DiagnosticInfo{DiagnosticKind::LookupMiss, "lookup_misses", "misses",
                   "Surface points that no radiance volume serves: directions are sampled from the BSDF alone there.",
                   0xffffff00u},
    DiagnosticInfo{DiagnosticKind::ClampedSample, "clamped_records", "clamped",
                   "Training samples brighter than the pending sums can hold: the field is too dark there, the "
                   "picture is not.",
                   0xffff8000u},
};

}  // namespace

std::span<const DiagnosticInfo> all_diagnostics() { return kDiagnostics; }
const DiagnosticInfo& info_of(DiagnosticKind kind) { return kDiagnostics[index_of(kind)]; }

DiagnosticCounts counted_diagnostics(const Snapshot& snapshot) {
    const PassCounters& counters = snapshot.counters;
    // A radiance map gets its training samples before the first pass of the picture.
    const bool has_map = snapshot.field && !info_of(snapshot.slot.method).learns;
    return {counters.invalid_samples, snapshot.is_closed ? counters.path.escaped : 0,
            counters.path.method.lookup_misses,
            has_map ? snapshot.field->clamped_records : counters.path.method.clamped_records};
}

std::uint64_t DiagnosticsMap::count(DiagnosticKind kind) const {
    std::uint64_t sum = 0;
    for (const Pixel& pixel : pixels) sum += pixel[index_of(kind)];
    return sum;
}

std::size_t DiagnosticsMap::pixel_count(DiagnosticKind kind) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(pixels, [&](const Pixel& pixel) { return pixel[index_of(kind)] > 0; }));
}

std::string summary_of(const DiagnosticsMap& map) {
    std::string text;
    for (const DiagnosticInfo& info : all_diagnostics()) {
        const std::uint64_t count = map.found[index_of(info.id)];
        if (count == 0) continue;
        const std::size_t pixels = map.pixel_count(info.id);
        text += fmt::format("{}{} {} in {} {}", text.empty() ? "" : ", ", count, info.label, pixels,
                            pixels == 1 ? "pixel" : "pixels");
    }
    if (text.empty()) text = "nothing wrong found";
    if (!map.is_complete) return text + fmt::format("; traced {} of {} samples a pixel", map.traced, map.samples);
    return text + (map.has_moving_tables ? ", with the field as learned by now" : "");
}

}  // namespace pl::diagnose
