// The two sides of a comparison: the run, its stored picture at the cursor, and the label.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/base/choice.h"
#include "ui/plot/run_lines.h"
#include "ui/worker/published_frame.h"

namespace pl {

// The mode of a comparison and the choice of its two sides: settings of the window, not of the rendering.

namespace ui {
enum class CompareMode { Off, Split, Flip, SideBySide, Difference, ErrorMap };
}

template <>
inline constexpr auto kChoices<ui::CompareMode> = std::to_array<ChoiceInfo<ui::CompareMode>>({
    {ui::CompareMode::Off, "off", "off"},
    {ui::CompareMode::Split, "split", "split"},
    {ui::CompareMode::Flip, "flip", "flip"},
    {ui::CompareMode::SideBySide, "side by side", "side by side"},
    {ui::CompareMode::Difference, "difference", "difference"},
    {ui::CompareMode::ErrorMap, "error map", "error map"},
});

}  // namespace pl

namespace pl::ui {

constexpr CompareMode stepped(CompareMode mode, int steps) {
    constexpr int kCompareModeCount = static_cast<int>(kChoices<CompareMode>.size());
    const int index = (static_cast<int>(mode) + steps % kCompareModeCount + kCompareModeCount) % kCompareModeCount;
    return static_cast<CompareMode>(index);
}

/// The choice of a side: automatic, a run by its number, the reference, or the picture of a file.
struct SideChoice {
    enum class What { Automatic, Run, Reference, File };
    What what = What::Automatic;
    std::uint64_t run = 0;

    friend bool operator==(const SideChoice&, const SideChoice&) = default;
};

struct CompareState {
    CompareMode mode = CompareMode::Off;
    SideChoice a;
    SideChoice b;
    float split = 0.5f;         ///< position of the line, as a share of the picture's width
    bool shows_second = false;  ///< of CompareMode::Flip
};

/// A converged picture for comparison.
struct ReferencePicture {
    std::uint64_t picture = 0;  ///< its content, as RunLabel::picture
    std::shared_ptr<const HalfPicture> pixels;
    std::string label;          ///< "reference, 512 spp"
    double noise_relmse = 0.0;  ///< of the mean of its halves
};

/// A picture that was opened from a file, to be compared with.
struct OpenedPicture {
    std::shared_ptr<const HalfPicture> pixels;
    std::string name;
    bool is_display = false;  ///< 8-bit display values, decoded: shown as they are, and not measured
};

struct CompareSide {
    std::uint64_t run = 0;  ///< 0: the reference, or a file
    bool is_reference = false;
    bool is_display = false;                     ///< OpenedPicture::is_display
    std::shared_ptr<const HalfPicture> picture;  ///< null if none is kept at the cursor
    std::string label;                           ///< method, back end, samples, seconds; or the missing picture
    std::uint32_t color = 0xffe4e6eau;           ///< of the method, opaque ARGB
    bool is_live = false;  ///< of a run in progress without cursor: a newer frame may replace the picture
    MethodId method{};
    std::string backend;
    /// Charged seconds of placement and precomputation; 0 for warm runs.
    std::optional<double> setup_seconds;
    std::shared_ptr<const PublishedFrame> frame;  ///< that newer frame; null: `picture` is shown
};

struct CompareSides {
    std::optional<CompareSide> a;
    std::optional<CompareSide> b;

    /// Both pictures have the same size, and linear values.
    bool fit_together() const;
};

using FramePtr = std::shared_ptr<const PublishedFrame>;

/// The input of a comparison.
struct CompareInput {
    RunList runs;
    std::uint64_t picture = 0;  ///< in the window: runs of others are not compared
    CurveKind kind;
    Cursor cursor;
    const ReferencePicture* reference = nullptr;  ///< not used if it is of another picture
    const OpenedPicture* file = nullptr;
};

/// Replaces the picture of a live side by a frame of the same method and back end at full resolution.
void show_newer(CompareSide& side, const FramePtr& frame);
/// The side of a run that renders in turns with another: the stored picture of the newest run like it, and its newest frame,
/// which may be null.
CompareSide side_in_turns(const CompareInput& input, const RunLabel& label, const FramePtr& frame);

/// Chosen sides, or automatic ones: A is the run in progress, else the newest; B is its baseline, else another run, else
/// the reference. A side that does not exist is empty.
CompareSides resolve_sides(const CompareInput& input, const CompareState& state);

}  // namespace pl::ui
