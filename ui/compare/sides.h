// The two pictures of a comparison: which run, which of its stored pictures, and what is written on it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/accuracy/cursor_table.h"
#include "ui/compare/compare_state.h"
#include "ui/worker/published_frame.h"

namespace pl {

/// A converged picture to compare with.
struct ReferencePicture {
    std::uint64_t picture = 0;  ///< what it shows, as RunLabel::picture
    std::shared_ptr<const HalfPicture> pixels;
    std::string label;          ///< "reference, 512 spp"
    double noise_relmse = 0.0;  ///< of the mean of its halves
};

struct CompareSide {
    std::uint64_t run = 0;  ///< 0: the reference
    bool is_reference = false;
    std::shared_ptr<const HalfPicture> picture;  ///< null: there is none at the cursor
    std::string label;                           ///< method, back end, samples, seconds; or what is missing
    std::uint32_t color = 0xffe4e6eau;           ///< of the method, opaque ARGB
    bool is_live = false;  ///< the newest picture of a run that goes on: a newer frame of it may be shown instead
    MethodId method = MethodId::Default;
    std::string backend;
    /// Placing and precomputing as far as the run was charged for it: nothing if it was warm.
    std::optional<double> setup_seconds;
    std::shared_ptr<const PublishedFrame> frame;  ///< that newer frame; null: `picture` is shown
};

struct CompareSides {
    std::optional<CompareSide> a;
    std::optional<CompareSide> b;

    /// Can they be laid over each other pixel by pixel?
    bool fit_together() const;
};

using FramePtr = std::shared_ptr<const PublishedFrame>;

/// What a comparison is made from.
struct CompareInput {
    RunList runs;
    std::uint64_t picture = 0;  ///< in the window: runs of others are not compared
    CurveKind kind;
    Cursor cursor;
    const ReferencePicture* reference = nullptr;  ///< may be of another picture: then it is not used
};

/// Lets a live side show a frame, if that is a whole one of the same method and back end.
void show_newer(CompareSide& side, const FramePtr& frame);
/// The side of a method that renders in turns with another: what its newest run has stored, and its newest frame, which
/// may be null.
CompareSide side_in_turns(const CompareInput& input, MethodId method, const FramePtr& frame);

/// Sides that are chosen as they are asked for; automatic ones so that A is the run in progress or the newest, and B what
/// it is measured against: default, else another run, else the reference. A side that does not exist is empty.
CompareSides resolve_sides(const CompareInput& input, const CompareState& state);

}  // namespace pl
