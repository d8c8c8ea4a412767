// What may go wrong on a path, how often it did in a picture, and at which pixels. All that a pass pays for is
// a comparison for each record, whether it is clamped: the rest is counted anyway, or looked for afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/snapshot.h"

namespace pl {

enum class Diagnostic : std::uint32_t {
    Invalid,        ///< samples
    Escaped,        ///< paths, of a camera that closed surfaces surround
    LookupMiss,     ///< surface points
    ClampedRecord,  ///< records
};
inline constexpr std::size_t kDiagnosticCount = 4;

struct DiagnosticInfo {
    Diagnostic id;
    std::string_view name;   ///< in files
    std::string_view label;  ///< on screen, behind a number
    std::string_view meaning;
    std::uint32_t color;  ///< opaque ARGB of its marks
};
std::span<const DiagnosticInfo> all_diagnostics();
const DiagnosticInfo& info_of(Diagnostic diagnostics);

/// How often each happened.
using DiagnosticCounts = std::array<std::uint64_t, kDiagnosticCount>;

/// What the passes of a picture have counted, and those of the radiance map it goes by.
DiagnosticCounts counted_diagnostics(const Snapshot& snapshot);

/// All that it takes to look for diagnostics in a picture, taken out of a session at one moment: see
/// Session::diagnostics_input(). May move to another thread.
struct DiagnosticsInput {
    int width = 0;
    int height = 0;
    DiagnosticCounts counted{};
    std::vector<std::uint32_t> invalid{};  ///< samples of each pixel, as the film knows them; empty if there are none

    std::uint32_t first_sample = 0;  ///< number of the first pass
    std::uint32_t samples = 0;       ///< complete passes
    std::uint32_t next_pixel = 0;    ///< of the pass under way: pixels before it have one more sample

    std::shared_ptr<const HostScene> scene{};
    std::shared_ptr<const HostVolumes>
        volumes{};  ///< null for methods without tables, which have no more of what follows
    FieldShape shape{};
    HostField field{};
    MixtureSettings mixture{};
    PathSettings path{};
    Camera camera{};
    bool is_closed = false;            ///< a path that escapes was lost
    bool has_moving_tables = false;    ///< they are not what the passes went by
    bool has_clamped_records = false;  ///< tracing again meets the records of the passes, and sees which are clamped
};

/// What went wrong where.
struct DiagnosticsMap {
    using Pixel = std::array<std::uint32_t, kDiagnosticCount>;

    int width = 0;
    int height = 0;
    std::uint32_t samples = 0;  ///< of each pixel in the picture
    std::uint32_t traced = 0;   ///< of them, those that were traced again, the newest first
    bool is_complete =
        false;  ///< all that was counted has been found, or all samples were traced again; see find_diagnostics()
    bool has_moving_tables = false;
    bool has_clamped_records = false;
    DiagnosticCounts counted{};   ///< by the passes themselves
    DiagnosticCounts found{};     ///< sums over the pixels, once the search is over
    std::vector<Pixel> pixels{};  ///< [row][column]

    std::uint64_t count(Diagnostic diagnostics) const;
    std::size_t pixel_count(Diagnostic diagnostics) const;
};

/// Where invalid samples were is what the film knows. For the rest the passes are traced again, the newest first: paths are
/// decided by scene, pixel and number, so that they are the same ones, except where a method has learned since. Ends when
/// everything that was counted has been found (of clamped records what 16 samples a pixel show), or when `stop` is raised,
/// with what was found by then. Calls `told` with the share of passes that are done. `threads` 0: all.
DiagnosticsMap find_diagnostics(DiagnosticsInput source, int threads, const StopFlag* stop = nullptr,
                                const std::function<void(double share)>& told = {});

/// "12 invalid in 7 pixels, 3 escaped in 3 pixels; of 64 samples a pixel", for people.
std::string summary_of(const DiagnosticsMap& map);

/// Darkens a picture and puts the colors of diagnostics where it was, in rings that can be seen from afar where there are few; of
/// several at a pixel the first of all_diagnostics() shows. Rows of ARGB, `pitch` pixels apart, of the map's size.
void mark_diagnostics(const DiagnosticsMap& map, std::uint32_t* out, std::size_t pitch);

}  // namespace pl
