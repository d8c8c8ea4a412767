// Defects of a picture: found by tracing its paths again, and marked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/session.h"
#include "core/session/snapshot.h"

namespace pl::diagnose {

// Diagnostics: defects of paths and of the learned field by kind, their counts in a picture, and their map over its
// pixels. A pass pays for them one comparison for each training sample, whether it is clamped; it keeps the other
// counts in any case.

enum class DiagnosticKind : std::uint32_t {
    InvalidSample,  ///< NaN, infinite or negative: left out of the film
    EscapedPath,    ///< left the scene although closed surfaces surround the camera
    LookupMiss,     ///< a surface point that no radiance volume serves
    ClampedSample,  ///< a training sample brighter than the pending sums can hold
};
inline constexpr std::size_t kDiagnosticCount = 4;

constexpr std::size_t index_of(DiagnosticKind kind) { return static_cast<std::size_t>(kind); }

struct DiagnosticInfo {
    DiagnosticKind id;
    std::string_view name;     ///< in files
    std::string_view label;    ///< on screen, behind a number
    std::string_view meaning;  ///< one sentence, for tooltips
    std::uint32_t color;       ///< of its marks, opaque ARGB
};
/// In the order of importance: of several kinds at a pixel the first one is shown.
std::span<const DiagnosticInfo> all_diagnostics();
const DiagnosticInfo& info_of(DiagnosticKind kind);

/// Occurrences by kind.
using DiagnosticCounts = std::array<std::uint64_t, kDiagnosticCount>;

/// Counts of a picture's own passes, and of the probes that filled the radiance map it samples from.
DiagnosticCounts counted_diagnostics(const Snapshot& snapshot);

/// Occurrences by kind and pixel, as find_diagnostics() locates them.
struct DiagnosticsMap {
    using Pixel = std::array<std::uint32_t, kDiagnosticCount>;

    int width = 0;
    int height = 0;
    std::uint32_t samples = 0;       ///< of each pixel in the picture
    std::uint32_t traced = 0;        ///< of these, the newest ones, whose paths were traced again
    bool is_complete = false;        ///< every counted occurrence was located, or every sample was traced again
    bool has_moving_tables = false;  ///< the field has been updated since it was sampled by the paths
    bool knows_clamped = false;      ///< clamped training samples could be located
    DiagnosticCounts counted{};      ///< occurrences in the passes
    DiagnosticCounts found{};        ///< sums over the pixels, once the search is over
    std::vector<Pixel> pixels{};     ///< [row][column]

    std::uint64_t count(DiagnosticKind kind) const;
    std::size_t pixel_count(DiagnosticKind kind) const;
};

/// "12 invalid in 7 pixels, 3 escaped in 3 pixels", for display.
std::string summary_of(const DiagnosticsMap& map);

// Locating the diagnostics of a picture: the pixels of the samples, paths and lookups that its passes counted.

/// The passes to search, and their counts.
struct DiagnosticsInput {
    PassReplay passes;
    DiagnosticCounts counted{};
};

/// Of the session's current picture. Throws Error(Usage) if its view shows no paths.
DiagnosticsInput diagnostics_input(const Session& session, FilmSlot slot);

/// Invalid samples come from the film; for the other kinds the passes are traced again, newest first, by
/// replay_path(). Ends when every counted occurrence is located (clamped training samples: after 16 samples per
/// pixel, since the field has changed too much before those), when all passes are traced, or when `stop` is raised.
/// Calls `told` with the share of passes traced. `threads` 0: all.
DiagnosticsMap find_diagnostics(DiagnosticsInput source, int threads, const StopFlag* stop = nullptr,
                                const std::function<void(double share)>& told = {});

// Marks of diagnostics in a picture: a picture and a map in, a marked picture out.

/// Pixels of a picture in place: rows of ARGB, `pitch` pixels apart.
struct PixelRows {
    std::uint32_t* argb = nullptr;
    std::size_t pitch = 0;

    std::uint32_t& at(int x, int y) const {
        return argb[static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(x)];
    }
};

/// Darkens the picture to a quarter and colors the pixels of the map that have occurrences; isolated ones get a ring,
/// visible from a distance. Of several kinds at a pixel the first one of all_diagnostics() is shown. The picture has
/// the map's size.
void mark_diagnostics(const DiagnosticsMap& map, PixelRows picture);

}  // namespace pl::diagnose
