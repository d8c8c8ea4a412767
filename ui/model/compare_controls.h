// The comparison of pictures and runs: the runs of this session, the two sides, runs in turns.
#pragma once

#include "ui/compare/compare_plan.h"
#include "ui/model/references.h"
#include "ui/plot/accuracy_model.h"

namespace pl::ui {

class CompareControls {
public:
    CompareControls(RenderLink& link, Messages& messages, const RenderControls& render, const References& references)
        : link_(link), messages_(messages), render_(render), references_(references) {}

    /// Takes the newest runs; once per frame of the window.
    void update();

    /// The runs of this session as the accuracy panel shows them.
    AccuracyModel& accuracy() { return accuracy_; }
    const AccuracyModel& accuracy() const { return accuracy_; }

    const CompareState& state() const { return state_; }
    /// The tiles of the comparison in `view`; none without a comparison, and while the camera moves.
    ComparePlan plan(const Rect& view, const PictureZoom& zoom = {}) const;
    void set_mode(CompareMode mode);
    void step_mode(int steps);
    /// The single picture of the present method, without turns.
    void end();
    void flip();  ///< to the other side
    void choose_side(bool second, const SideChoice& choice);
    /// Makes it side B.
    void open_picture(OpenedPicture picture);
    /// Null without one.
    const OpenedPicture* opened() const { return opened_ ? &*opened_ : nullptr; }
    void set_split(float share);
    /// Sides are the pictures at the cursor: setting it starts a comparison.
    void set_cursor(const Cursor& cursor);

    /// The present run and the one compared with it render in turns of equal time: the run that is chosen as B, with its settings, else
    /// another method.
    bool in_turns() const { return link_.turns().has_value(); }
    void set_turns(bool on);
    /// In turns the labels of both runs; the first is now().
    std::optional<std::array<RunLabel, 2>> labels_in_turns() const;
    /// In turns both runs in words.
    std::optional<TurnsHeadline> headline() const;
    /// The label of the present run, whose learned field the window shows.
    RunLabel now() const { return label_of(render_.method(), render_.settings()); }

private:
    CompareInput input() const;
    MethodId other_method() const;
    TurnSides wanted_turns() const;
    RunLabel label_of(MethodId method, const RenderSettings& settings) const;

    RenderLink& link_;
    Messages& messages_;
    const RenderControls& render_;
    const References& references_;
    AccuracyModel accuracy_;
    CompareState state_;
    std::optional<OpenedPicture> opened_;
};

}  // namespace pl::ui
