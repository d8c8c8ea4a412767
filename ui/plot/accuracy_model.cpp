#include "ui/plot/accuracy_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pl::ui {
namespace {

bool is_measured(RunList runs, std::uint64_t picture, ErrorMetric metric) {
    return std::ranges::any_of(runs, [&](const auto& run) {
        return run->label.picture == picture && std::ranges::any_of(run->points, [&](const LivePoint& point) {
                   return error_of(point, metric).has_value();
               });
    });
}

}  // namespace

void AccuracyModel::update(std::shared_ptr<const LiveRunSet> runs, std::uint64_t picture, double floor,
                           const RunBase& base, bool in_turns) {
    if (runs == runs_ && picture == picture_ && floor == floor_ && base == base_ && in_turns == in_turns_) return;
    runs_ = std::move(runs);
    picture_ = picture;
    floor_ = floor;
    base_ = base;
    in_turns_ = in_turns;
    recompute();
}

std::uint32_t AccuracyModel::passes_of(const LiveRun& run) const {
    return run.in_progress ? std::max(run.passes, passes_) : run.passes;
}

bool AccuracyModel::is_old(std::uint64_t number) const {
    const auto run = find_run(runs(), number);
    return run && !run->points.empty() && pl::is_old(run->points.back().spp, passes_of(*run));
}

bool AccuracyModel::is_old(const RunRow& row) const { return is_old(row.run) || is_old(row.base); }

std::string AccuracyModel::age_text(const RunRow& row) const {
    const auto run = find_run(runs(), is_old(row.run) ? row.run : row.base);
    return run ? fmt::format("{}: measured after {} of {} samples per pixel.", name_of(run->label),
                             run->points.back().spp, passes_of(*run))
               : "";
}

void AccuracyModel::set_metric(ErrorMetric metric) {
    if (metric == wanted_.metric) return;
    wanted_.metric = metric;
    if (cursor_.kind == Cursor::Kind::EqualError) cursor_ = {};  // the error of another metric
    recompute();
    fit_view();
}

void AccuracyModel::set_axis(CostAxis axis) {
    if (axis == wanted_.axis) return;
    wanted_.axis = axis;
    if (cursor_.kind == Cursor::Kind::EqualCost) cursor_ = {};
    recompute();
    fit_view();
}

void AccuracyModel::set_cursor(const Cursor& cursor) {
    cursor_ = cursor.at > 0.0 && std::isfinite(cursor.at) ? cursor : Cursor{};
    rows_ = cursor_rows(runs(), picture_, kind_, cursor_, base_);
}

void AccuracyModel::toggle_hidden(std::uint64_t run) {
    if (hidden_.erase(run) == 0) hidden_.insert(run);
    recompute();
}

double AccuracyModel::floor() const { return kind_.metric == ErrorMetric::RelMse ? floor_ : 0.0; }

void AccuracyModel::fit_view() {
    view_kept_ = false;
    view_ = PlotView(fit_range(lines_));
}

void AccuracyModel::pan_view(Vec2f pixels, const Rect& frame) {
    view_.pan(pixels, frame);
    keep_view();
}

void AccuracyModel::zoom_view(float notches, Vec2f at, const Rect& frame) {
    view_.zoom(notches, at, frame);
    keep_view();
}

void AccuracyModel::keep_view() {
    view_kept_ = true;
    view_.keep_at(fit_range(lines_));
}

void AccuracyModel::recompute() {
    const ErrorMetric before = kind_.metric;
    kind_ = wanted_;
    if (!is_measured(runs(), picture_, kind_.metric)) kind_.metric = ErrorMetric::Noise;
    if (kind_.metric != before && cursor_.kind == Cursor::Kind::EqualError) cursor_ = {};
    make_lines();
    table_ = make_run_table(runs(), picture_, base_, in_turns_);
    rows_ = cursor_rows(runs(), picture_, kind_, cursor_, base_);
    if (view_kept_)
        keep_view();  // of another picture the curves may lie elsewhere
    else
        view_ = PlotView(fit_range(lines_));
}

void AccuracyModel::make_lines() {
    lines_.clear();
    for (const auto& run : runs()) {
        const RunLabel& label = run->label;
        if (label.picture != picture_) continue;
        lines_.push_back({.run = run->number,
                          .name = name_of(label),
                          .color = run_color(runs(), label),
                          .is_dashed = is_dashed(label),
                          .marker = marker_of(label),
                          .hidden = hidden_.count(run->number) > 0,
                          .in_progress = run->in_progress,
                          .points = plot_points(*run, kind_)});
    }
}

}  // namespace pl::ui
