#include "core/diagnose/diagnostics.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/diagnose/record_path.h"
#include "core/diagnose/replay_path.h"

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

namespace {

/// Targets depend on the present field, which differs too much from the field of older passes.
constexpr std::uint32_t kPassesForClamped = 16;

/// A map with the data that the film holds: counts and invalid samples.
DiagnosticsMap begin_map(const PassReplay& passes, const DiagnosticCounts& counted) {
    DiagnosticsMap map{.width = passes.width,
                       .height = passes.height,
                       .samples = passes.samples,
                       .has_moving_tables = passes.has_moving_tables,
                       .knows_clamped = passes.repeats_training,
                       .counted = counted,
                       .pixels = std::vector<DiagnosticsMap::Pixel>(static_cast<std::size_t>(passes.width) *
                                                                    static_cast<std::size_t>(passes.height))};
    for (std::size_t i = 0; i < passes.invalid.size(); ++i)
        map.pixels[i][index_of(DiagnosticKind::InvalidSample)] = passes.invalid[i];
    return map;
}

class Search {
public:
    Search(DiagnosticsInput source, int threads, const StopFlag* stop)
        : passes_(std::move(source.passes)), threads_(threads), stop_(stop) {
        map_ = begin_map(passes_, source.counted);
        field_ = field_of(passes_);
    }

    DiagnosticsMap run(const std::function<void(double)>& told) {
        if (!is_all_found() && passes_.next_pixel > 0) trace_pass(passes_.samples, passes_.next_pixel);
        while (!is_stopped() && !is_all_found() && map_.traced < map_.samples) {
            trace_pass(map_.samples - 1 - map_.traced, static_cast<std::uint32_t>(map_.pixels.size()));
            if (is_stopped()) break;
            ++map_.traced;
            if (told) told(static_cast<double>(map_.traced) / map_.samples);
        }
        for (const DiagnosticInfo& info : all_diagnostics()) map_.found[index_of(info.id)] = map_.count(info.id);
        map_.is_complete = is_all_found() || map_.traced == map_.samples;
        return std::move(map_);
    }

private:
    bool is_stopped() const { return stop_ != nullptr && *stop_; }

    /// With a field updated since the pass, fewer occurrences than were counted may be found.
    bool is_all_found() const {
        return std::ranges::all_of(all_diagnostics(), [&](const DiagnosticInfo& info) {
            return !is_sought(info.id) || map_.count(info.id) >= map_.counted[index_of(info.id)];
        });
    }
    bool is_sought(DiagnosticKind kind) const {
        if (kind == DiagnosticKind::InvalidSample) return false;  // counted by the film
        return kind != DiagnosticKind::ClampedSample || (map_.knows_clamped && map_.traced < kPassesForClamped);
    }

    void trace_pass(std::uint32_t pass, std::uint32_t pixels) {
        constexpr std::uint32_t kChunk = 256;
        ChunkQueue queue(0, pixels, kChunk, stop_);
        run_on_plain_threads(threads_, [&](int) {
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel) trace_pixel(pixel, pass);
        });
    }

    void trace_pixel(std::uint32_t pixel, std::uint32_t pass) {
        const PathDefects defects = replay_path(passes_, field_, pixel, pass);
        DiagnosticsMap::Pixel& found = map_.pixels[pixel];
        if (passes_.is_closed) found[index_of(DiagnosticKind::EscapedPath)] += defects.escapes;
        found[index_of(DiagnosticKind::LookupMiss)] += defects.lookup_misses;
        found[index_of(DiagnosticKind::ClampedSample)] += defects.clamped_samples;
    }

    PassReplay passes_;
    int threads_;
    const StopFlag* stop_;
    AnyFieldView field_;  ///< of passes_
    DiagnosticsMap map_;
};

}  // namespace

DiagnosticsInput diagnostics_input(const Session& session, FilmSlot slot) {
    return {.passes = session.pass_replay(slot), .counted = counted_diagnostics(session.summary(slot))};
}

DiagnosticsMap find_diagnostics(DiagnosticsInput source, int threads, const StopFlag* stop,
                                const std::function<void(double)>& told) {
    if (threads <= 0) threads = usable_threads();
    return Search(std::move(source), threads, stop).run(told);
}

namespace {

constexpr int kRingRadius = 4;

/// Within the radius of a ring around a pixel; with more occurrences, rings would hide the pixels they mark.
constexpr int kMostWithRings = 4;

std::uint32_t darkened(std::uint32_t argb) { return 0xff000000u | ((argb >> 2) & 0x3f3f3fu); }

/// Index into all_diagnostics() of the kind that a pixel shows; kDiagnosticCount if it has none.
std::size_t kind_at(const DiagnosticsMap& map, int x, int y) {
    const DiagnosticsMap::Pixel& pixel =
        map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
    const auto first = std::ranges::find_if(pixel, [](std::uint32_t count) { return count > 0; });
    return static_cast<std::size_t>(first - pixel.begin());
}

/// Calls fn(u, v) for the pixels of the map at most `radius` rows and columns away.
template <class Fn>
void for_each_around(const DiagnosticsMap& map, int x, int y, int radius, Fn&& fn) {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, map.height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, map.width - 1); ++u) fn(u, v);
}

bool is_isolated(const DiagnosticsMap& map, int x, int y) {
    int count = 0;
    for_each_around(map, x, y, kRingRadius,
                    [&](int u, int v) { count += kind_at(map, u, v) != kDiagnosticCount ? 1 : 0; });
    return count <= kMostWithRings;
}

/// A square ring; of radius 0 the pixel itself.
void draw_ring(const DiagnosticsMap& map, int x, int y, int radius, std::uint32_t color, PixelRows picture) {
    for_each_around(map, x, y, radius, [&](int u, int v) {
        if (std::max(std::abs(u - x), std::abs(v - y)) == radius) picture.at(u, v) = color;
    });
}

void draw_rings(const DiagnosticsMap& map, int radius, PixelRows picture) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const std::size_t kind = kind_at(map, x, y);
            if (kind == kDiagnosticCount || (radius > 0 && !is_isolated(map, x, y))) continue;
            draw_ring(map, x, y, radius, all_diagnostics()[kind].color, picture);
        }
}

}  // namespace

void mark_diagnostics(const DiagnosticsMap& map, PixelRows picture) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) picture.at(x, y) = darkened(picture.at(x, y));
    draw_rings(map, kRingRadius, picture);
    draw_rings(map, 0, picture);  // above the rings
}

}  // namespace pl::diagnose
