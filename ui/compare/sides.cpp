#include "ui/compare/sides.h"

#include <algorithm>

#include <fmt/format.h>

namespace pl::ui {
namespace {

constexpr double kEqualEnough = 1.1;  ///< largest ratio of equal costs: points are a fifth apart

using RunPtr = std::shared_ptr<const LiveRun>;

bool can_be_a_side(const LiveRun& run, const CompareInput& input) {
    return run.label.picture == input.picture && !run.points.empty();
}

/// The run in progress, else the newest.
RunPtr first_run(const CompareInput& input) {
    RunPtr best;
    for (const RunPtr& run : input.runs)
        if (can_be_a_side(*run, input) && (!best || run->in_progress || !best->in_progress)) best = run;
    return best;
}

RunPtr second_run(const CompareInput& input, const LiveRun& first) {
    if (RunPtr base = base_of(input.runs, first)) return base;
    RunPtr best;
    for (const RunPtr& run : input.runs)
        if (can_be_a_side(*run, input) && run->number != first.number) best = run;
    return best;
}

std::string cursor_text(const CompareInput& input) {
    const bool seconds = input.kind.axis == CostAxis::Seconds;
    if (input.cursor.kind == Cursor::Kind::EqualCost)
        return fmt::format("at {:.3g} {}", input.cursor.at, seconds ? "s" : "spp");
    return fmt::format("at {} {:.3g}", info_of(input.kind.metric).label, input.cursor.at);
}

CompareSide side_of(const CompareInput& input, const LiveRun& run) {
    CompareSide side{.run = run.number,
                     .picture = {},
                     .label = {},
                     .color = run_color(input.runs, run.label),
                     .method = run.label.method,
                     .backend = run.label.backend,
                     .setup_seconds = {},
                     .frame = {}};
    const auto index = point_at(run, input.kind, input.cursor);
    if (!index) {
        side.label = input.cursor.kind == Cursor::Kind::None
                         ? fmt::format("{}: no picture is kept", name_of(run.label))
                         : fmt::format("{}: no picture {}", name_of(run.label), cursor_text(input));
        return side;
    }
    const LivePoint& point = run.points[*index];
    side.picture = point.picture;
    side.setup_seconds = point.clocks.place + point.clocks.precompute;
    side.label = fmt::format("{}  {} spp  {:.3g} s", name_of(run.label), point.spp, charged_seconds(point.clocks));
    side.is_live = run.in_progress && input.cursor.kind == Cursor::Kind::None;
    const double off = cost_of(point, input.kind.axis) / input.cursor.at;
    if (input.cursor.kind == Cursor::Kind::EqualCost && (off < 1.0 / kEqualEnough || off > kEqualEnough))
        side.label += "  (nearest kept)";
    return side;
}

std::optional<CompareSide> reference_side(const CompareInput& input) {
    const ReferencePicture* reference = input.reference;
    if (reference == nullptr || reference->picture != input.picture || !reference->pixels) return std::nullopt;
    return CompareSide{.is_reference = true,
                       .picture = reference->pixels,
                       .label = reference->label,
                       .backend = {},
                       .setup_seconds = {},
                       .frame = {}};
}

std::optional<CompareSide> file_side(const CompareInput& input) {
    if (input.file == nullptr) return std::nullopt;
    return CompareSide{.is_display = input.file->is_display,
                       .picture = input.file->pixels,
                       .label = input.file->name + (input.file->is_display ? "  display values" : ""),
                       .backend = {},
                       .setup_seconds = {},
                       .frame = {}};
}

std::optional<CompareSide> chosen_side(const CompareInput& input, const SideChoice& choice) {
    if (choice.what == SideChoice::What::Reference) return reference_side(input);
    if (choice.what == SideChoice::What::File) return file_side(input);
    const RunPtr run = find_run(input.runs, choice.run);
    if (!run || !can_be_a_side(*run, input)) return std::nullopt;
    return side_of(input, *run);
}

}  // namespace

bool CompareSides::fit_together() const {
    return a && b && a->picture && b->picture && !a->is_display && !b->is_display &&
           a->picture->width == b->picture->width && a->picture->height == b->picture->height;
}

void show_newer(CompareSide& side, const FramePtr& frame) {
    if (!side.is_live || !frame || frame->divider != 1 || frame->backend.name != side.backend) return;
    const Snapshot& snapshot = frame->snapshot;
    if (!(snapshot.slot == FilmSlot{side.method, View::Beauty})) return;
    const bool other_size =
        side.picture && (side.picture->width != snapshot.width || side.picture->height != snapshot.height);
    if (other_size) return;
    side.frame = frame;
    const Clocks& clocks = snapshot.clocks;
    const double setup = side.setup_seconds.value_or(clocks.place + clocks.precompute);
    side.label = side.label.substr(0, side.label.find("  ")) +
                 fmt::format("  {} spp  {:.3g} s", snapshot.passes, setup + clocks.learn + clocks.render);
}

CompareSide side_in_turns(const CompareInput& input, const RunLabel& label, const FramePtr& frame) {
    CompareSide side{.picture = {},
                     .label = name_of(label) + "  no picture yet",
                     .color = run_color(input.runs, label),
                     .is_live = true,
                     .method = label.method,
                     .backend = label.backend,
                     .setup_seconds = {},
                     .frame = {}};
    for (const RunPtr& run : input.runs)
        if (can_be_a_side(*run, input) && are_of_one_kind(run->label, label)) side = side_of(input, *run);
    side.is_live = input.cursor.kind == Cursor::Kind::None;
    show_newer(side, frame);
    return side;
}

CompareSides resolve_sides(const CompareInput& input, const CompareState& state) {
    CompareSides sides;
    if (state.a.what != SideChoice::What::Automatic) sides.a = chosen_side(input, state.a);
    if (state.b.what != SideChoice::What::Automatic) sides.b = chosen_side(input, state.b);
    if (!sides.a) {  // also where a chosen run is one of another picture now
        const RunPtr run = first_run(input);
        sides.a = run ? std::optional(side_of(input, *run)) : reference_side(input);
    }
    if (!sides.b && sides.a && !sides.a->is_reference) {
        const RunPtr own = find_run(input.runs, sides.a->run);
        const RunPtr run = own ? second_run(input, *own) : first_run(input);
        sides.b = run ? std::optional(side_of(input, *run)) : reference_side(input);
    }
    return sides;
}

}  // namespace pl::ui
