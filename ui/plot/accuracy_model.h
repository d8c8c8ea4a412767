// The content and settings of the accuracy panel, without window: recomputed when runs or settings change, not for
// every frame.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ui/plot/plot_lines.h"
#include "ui/plot/run_lines.h"
#include "ui/plot/run_table.h"

namespace pl::ui {

class AccuracyModel {
public:
    AccuracyModel() { recompute(); }

    /// Takes the newest runs. `picture`: of the window (RunLabel::picture), `floor` the noise of its reference as
    /// relMSE, 0 without one.
    void update(std::shared_ptr<const LiveRunSet> runs, std::uint64_t picture, double floor, const RunBase& base = {},
                bool in_turns = false);

    /// Passes of the picture of the run in progress, which its points may not have yet. Once per frame of the window.
    void set_passes(std::uint32_t passes) { passes_ = passes; }
    /// Whether the numbers of a row are older than the pictures of its run and of the one that it is compared with.
    bool is_old(const RunRow& row) const;
    /// "Default CPU: measured after 11 of 44 samples per pixel.": of such a row.
    std::string age_text(const RunRow& row) const;

    /// Null before the first update.
    const LiveRunSet* set() const { return runs_.get(); }
    RunList runs() const { return runs_ ? RunList(runs_->runs) : RunList(); }
    std::uint64_t picture() const { return picture_; }

    ErrorMetric wanted_metric() const { return wanted_.metric; }
    /// The plotted metric: the picture's own noise if the wanted one was not measured in any run of the picture.
    const CurveKind& kind() const { return kind_; }
    const Cursor& cursor() const { return cursor_; }
    void set_metric(ErrorMetric metric);
    void set_axis(CostAxis axis);
    /// A cost or error that is not positive removes the cursor.
    void set_cursor(const Cursor& cursor);
    void toggle_hidden(std::uint64_t run);

    /// All runs of this picture.
    const std::vector<PlotLine>& lines() const { return lines_; }
    const RunTable& table() const { return table_; }
    const std::vector<CursorRow>& rows() const { return rows_; }
    /// Noise of the reference in the plotted metric: smaller errors are not significant. 0 if unknown.
    double floor() const;

    const PlotView& view() const { return view_; }
    /// By the user: the range is kept from now on, at most a decade beyond the curves; otherwise it follows them.
    void pan_view(Vec2f pixels, const Rect& frame);
    void zoom_view(float notches, Vec2f at, const Rect& frame);
    void fit_view();

private:
    std::uint32_t passes_of(const LiveRun& run) const;
    bool is_old(std::uint64_t number) const;
    void recompute();
    void make_lines();
    void keep_view();

    std::shared_ptr<const LiveRunSet> runs_;
    std::uint64_t picture_ = 0;
    double floor_ = 0.0;
    RunBase base_;
    bool in_turns_ = false;
    std::uint32_t passes_ = 0;
    CurveKind wanted_;
    CurveKind kind_;
    Cursor cursor_;
    std::set<std::uint64_t> hidden_;
    std::vector<PlotLine> lines_;
    RunTable table_;
    std::vector<CursorRow> rows_;
    PlotView view_;
    bool view_kept_ = false;
};

}  // namespace pl::ui
