#include "core/session/diagnostics.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "core/base/work_queue.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/targets/expected_sarsa.h"

namespace pl {
namespace {

constexpr std::array<DiagnosticInfo, kDiagnosticCount> kDiagnostics{
    DiagnosticInfo{Diagnostic::Invalid, "invalid_samples", "invalid",
                   "Samples that were NaN, infinite or negative: left out of the picture.", kInvalidPixel},
    DiagnosticInfo{Diagnostic::Escaped, "escaped_paths", "escaped",
                   "Paths that left although closed surfaces surround the camera: they slipped through a crack.",
                   0xff00ffffu},
    DiagnosticInfo{Diagnostic::LookupMiss, "lookup_misses", "misses",
                   "Surface points that no radiance volume serves: directions come from the reflectance alone there.",
                   0xffffff00u},
    DiagnosticInfo{Diagnostic::ClampedRecord, "clamped_records", "clamped",
                   "Records brighter than tables can hold: what is learned there is too dark, the picture is not.",
                   0xffff8000u},
};

/// Records are those of tables as they are now, so that many passes tell no more.
constexpr std::uint32_t kPassesForRecords = 16;

constexpr std::size_t index_of(Diagnostic diagnostics) { return static_cast<std::size_t>(diagnostics); }

/// Samples directions as all guided methods do, but trains nothing: it counts the training samples that would be clamped.
template <GuidingField Field>
struct CountingMethod : Guided<Field, ExpectedSarsa> {
    std::uint32_t* clamped = nullptr;  ///< null for methods whose training samples differ

    void record(const TrainingSample<Field>& sample) const {
        if (clamped == nullptr || !sample.entry.is_trained()) return;
        *clamped += this->field.is_clamped(sample.target) ? 1u : 0u;
    }
};

/// Traces one path of the picture again with kernels that can do everything, which gives the same bits.
template <class M>
void trace_again(const DiagnosticsInput& source, const M& method, std::uint32_t pixel, std::uint32_t sample,
                 DiagnosticsMap::Pixel& found) {
    const SceneView scene = source.scene->view();
    const PixelGrid grid{static_cast<std::uint32_t>(source.width), static_cast<std::uint32_t>(source.height), sample};
    auto state = begin_path<kEveryFeature, M>(source.camera, source.path, grid, pixel);
    PathCounters counters;
    trace_path<kEveryFeature>(PathContext<M>{scene, method, source.path}, BvhIntersector{scene}, state, counters);
    const auto add = [&](Diagnostic diagnostics, std::uint64_t count) {
        found[index_of(diagnostics)] += static_cast<std::uint32_t>(count);
    };
    if (source.is_closed) add(Diagnostic::Escaped, counters.escaped);
    add(Diagnostic::LookupMiss, counters.method.lookup_misses);
}

class Search {
public:
    Search(DiagnosticsInput source, int threads, const StopFlag* stop)
        : source_(std::move(source)), threads_(threads), stop_(stop) {
        map_ = {.width = source_.width,
                .height = source_.height,
                .samples = source_.samples,
                .traced = 0,
                .is_complete = false,
                .has_moving_tables = source_.has_moving_tables,
                .has_clamped_records = source_.has_clamped_records,
                .counted = source_.counted,
                .pixels = std::vector<DiagnosticsMap::Pixel>(static_cast<std::size_t>(source_.width) *
                                                             static_cast<std::size_t>(source_.height))};
        for (std::size_t i = 0; i < source_.invalid.size(); ++i)
            map_.pixels[i][index_of(Diagnostic::Invalid)] = source_.invalid[i];
        if (source_.volumes) field_ = field_view(source_.shape, *source_.volumes, source_.field);
    }

    DiagnosticsMap run(const std::function<void(double)>& told) {
        if (!is_all_found() && source_.next_pixel > 0) trace_pass(source_.samples, source_.next_pixel);
        while (!is_stopped() && !is_all_found() && map_.traced < map_.samples) {
            trace_pass(map_.samples - 1 - map_.traced, static_cast<std::uint32_t>(map_.pixels.size()));
            if (is_stopped()) break;
            ++map_.traced;
            if (told) told(static_cast<double>(map_.traced) / map_.samples);
        }
        for (const DiagnosticInfo& diagnostics : all_diagnostics())
            map_.found[index_of(diagnostics.id)] = map_.count(diagnostics.id);
        map_.is_complete = is_all_found() || map_.traced == map_.samples;
        return std::move(map_);
    }

private:
    bool is_stopped() const { return stop_ != nullptr && *stop_; }

    /// With tables that have moved, as many as were counted may never be found.
    bool is_all_found() const {
        return std::ranges::all_of(all_diagnostics(), [&](const DiagnosticInfo& diagnostics) {
            return !is_sought(diagnostics.id) ||
                   map_.count(diagnostics.id) >= source_.counted[index_of(diagnostics.id)];
        });
    }
    bool is_sought(Diagnostic diagnostics) const {
        if (diagnostics == Diagnostic::Invalid) return false;  // the film knows
        return diagnostics != Diagnostic::ClampedRecord ||
               (source_.has_clamped_records && map_.traced < kPassesForRecords);
    }

    void trace_pass(std::uint32_t pass, std::uint32_t pixels) {
        constexpr std::uint32_t kChunk = 256;
        ChunkQueue queue(0, pixels, kChunk, stop_);
        run_on_plain_threads(threads_, [&](int) {
            for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel)
                    trace_pixel(pixel, source_.first_sample + pass);
        });
    }

    void trace_pixel(std::uint32_t pixel, std::uint32_t sample) {
        DiagnosticsMap::Pixel& found = map_.pixels[pixel];
        if (!source_.volumes) return trace_again(source_, DefaultMethod{}, pixel, sample, found);
        visit_field(field_, [&](const auto& field) {
            CountingMethod<std::remove_cvref_t<decltype(field)>> method;
            method.field = field;
            method.mixture = source_.mixture;
            if (source_.has_clamped_records) method.clamped = &found[index_of(Diagnostic::ClampedRecord)];
            trace_again(source_, method, pixel, sample, found);
        });
    }

    DiagnosticsInput source_;
    int threads_;
    const StopFlag* stop_;
    AnyFieldView field_;  ///< of the source
    DiagnosticsMap map_;
};

/// A quarter as bright.
std::uint32_t darkened(std::uint32_t argb) { return 0xff000000u | ((argb >> 2) & 0x3f3f3fu); }

/// Index of the diagnostics that shows at a pixel, or kDiagnosticCount.
std::size_t shown_at(const DiagnosticsMap& map, int x, int y) {
    const DiagnosticsMap::Pixel& pixel =
        map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
    const auto first = std::ranges::find_if(pixel, [](std::uint32_t count) { return count > 0; });
    return static_cast<std::size_t>(first - pixel.begin());
}

/// Calls fn(u, v) for all pixels of a picture at most so many rows and columns away.
template <class Fn>
void for_each_around(const DiagnosticsMap& map, int x, int y, int radius, Fn&& fn) {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, map.height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, map.width - 1); ++u) fn(u, v);
}

constexpr int kRingRadius = 4;

/// Many pixels are seen without rings, which would hide them.
bool is_in_a_crowd(const DiagnosticsMap& map, int x, int y) {
    constexpr int kMost = 4;
    int count = 0;
    for_each_around(map, x, y, kRingRadius,
                    [&](int u, int v) { count += shown_at(map, u, v) != kDiagnosticCount ? 1 : 0; });
    return count > kMost;
}

}  // namespace

std::span<const DiagnosticInfo> all_diagnostics() { return kDiagnostics; }
const DiagnosticInfo& info_of(Diagnostic diagnostics) { return kDiagnostics[index_of(diagnostics)]; }

DiagnosticCounts counted_diagnostics(const Snapshot& snapshot) {
    const PassCounters& counters = snapshot.counters;
    // A radiance map was recorded before the picture began.
    const bool has_map = snapshot.field && !info_of(snapshot.slot.method).learns;
    return {counters.invalid_samples, snapshot.is_closed ? counters.path.escaped : 0,
            counters.path.method.lookup_misses,
            has_map ? snapshot.field->clamped_records : counters.path.method.clamped_records};
}

std::uint64_t DiagnosticsMap::count(Diagnostic diagnostics) const {
    std::uint64_t sum = 0;
    for (const Pixel& pixel : pixels) sum += pixel[index_of(diagnostics)];
    return sum;
}

std::size_t DiagnosticsMap::pixel_count(Diagnostic diagnostics) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(pixels, [&](const Pixel& pixel) { return pixel[index_of(diagnostics)] > 0; }));
}

DiagnosticsMap find_diagnostics(DiagnosticsInput source, int threads, const StopFlag* stop,
                                const std::function<void(double)>& told) {
    if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return Search(std::move(source), threads, stop).run(told);
}

std::string summary_of(const DiagnosticsMap& map) {
    std::string text;
    for (const DiagnosticInfo& diagnostics : all_diagnostics()) {
        const std::uint64_t count = map.found[index_of(diagnostics.id)];
        if (count == 0) continue;
        const std::size_t pixels = map.pixel_count(diagnostics.id);
        text += fmt::format("{}{} {} in {} {}", text.empty() ? "" : ", ", count, diagnostics.label, pixels,
                            pixels == 1 ? "pixel" : "pixels");
    }
    if (text.empty()) text = "no diagnostics found";
    if (!map.is_complete) return text + fmt::format("; looked at {} of {} samples a pixel", map.traced, map.samples);
    return text + (map.has_moving_tables ? ", by what is learned now" : "");
}

void mark_diagnostics(const DiagnosticsMap& map, std::uint32_t* out, std::size_t pitch) {
    const auto at = [&](int x, int y) -> std::uint32_t& {
        return out[static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) at(x, y) = darkened(at(x, y));
    // What comes later lies on top: rings, then the pixels themselves.
    for (const bool is_ring : {true, false})
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x) {
                const std::size_t kind = shown_at(map, x, y);
                if (kind == kDiagnosticCount || (is_ring && is_in_a_crowd(map, x, y))) continue;
                const int radius = is_ring ? kRingRadius : 0;
                for_each_around(map, x, y, radius, [&](int u, int v) {
                    if (std::max(std::abs(u - x), std::abs(v - y)) == radius) at(u, v) = kDiagnostics[kind].color;
                });
            }
}

}  // namespace pl
