#include "core/diagnose/find_diagnostics.h"

#include <algorithm>

#include "core/base/work_queue.h"
#include "core/diagnose/record_path.h"
#include "core/diagnose/replay_path.h"

namespace pl::diagnose {
namespace {

/// Targets depend on the present field, which differs too much from that of older passes.
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
                for (std::uint32_t pixel = range.begin; pixel < range.end; ++pixel)
                    trace_pixel(pixel, passes_.first_sample + pass);
        });
    }

    void trace_pixel(std::uint32_t pixel, std::uint32_t sample) {
        const PathDefects defects = replay_path(passes_, field_, pixel, sample);
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

}  // namespace pl::diagnose
