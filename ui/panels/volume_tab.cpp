#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/model/window_choices.h"
#include "ui/panels/figure_curves.h"
#include "ui/panels/panels.h"
#include "ui/panels/volume_discs.h"

namespace pl::ui {
namespace {

void draw_choices(CellDisplay& display) {
    choice_row("quantity", "Of a cell.", &display.quantity, em(8.0f));
    same_line_for(em(13.0f));
    range_controls(display.range);
}

void draw_figures(const LightReport& report) {
    const GuidingFigures& figures = report.figures;
    text_row(
        "Field off by", interval_text(figures.table),
        "Kullback-Leibler divergence of the learned probabilities from those of the true light, in nats: 0 if they "
        "agree; 95 % interval.");
    text_row(
        "Paths off by", interval_text(figures.mixture),
        "The same of the mixture of BSDF and field that guided paths sample, from the true light times the BSDF.");
    text_row("Variance", figures.variance_factor ? interval_text(*figures.variance_factor) : "none by the BSDF",
             "Of one direction sampled by that mixture, over the variance of BSDF sampling. Below 1, guiding helps "
             "here. The light within a cell counts as its mean.");
    if (report.invalid_paths > 0)
        text_row("Invalid", fmt::format("{} paths", report.invalid_paths), "Counted as black.", colors::kWarning);
}

void draw_truth(const Selection& selection, const GuidingStatus* guiding) {
    const LightTracing& light = selection.light();
    if (!light.failure().empty()) {
        text_line(light.failure().c_str(), colors::kError);
        return;
    }
    if (light.report() == nullptr) {
        text_row("True light", "tracing its first paths");
        return;
    }
    const LightReport& report = *light.report();
    text_row("True light",
             fmt::format("{} paths per cell, {}", report.paths_per_cell, short_seconds(light.seconds())),
             "By paths of default from the volume, on a thread of low priority. Its time is on no other clock.");
    text_row("Light", std::string(label_of(report.target)),
             "The light that the method learns. With light samples and learn-from indirect, light that light "
             "samples find is left to them by multiple importance sampling, as the densities now are.");
    draw_figures(report);
    if (guiding != nullptr && !guiding->pays)
        text_row("Passes", "mostly unguided",
                 "Guiding does not pay in this picture: most of its paths sample the BSDF.");
}

void draw_summary(const VolumeInspection& volume) {
    const TableSummary summary = summarize(volume);
    const auto cells = static_cast<double>(volume.probability.size());
    text_row("Position",
             fmt::format("{:.4g}  {:.4g}  {:.4g}", volume.position.x, volume.position.y, volume.position.z));
    text_row("Normal", fmt::format("{:.3f}  {:.3f}  {:.3f}", volume.normal.x, volume.normal.y, volume.normal.z));
    text_row("Visits", short_number(static_cast<double>(summary.visits)), "Training samples of all cells.");
    text_row("Unseen", fmt::format("{} of {:.0f} cells", summary.empty_cells, cells),
             "Cells without training samples.");
    text_row("Entropy", fmt::format("{:.2f} of {:.2f} bits", summary.entropy_bits, std::log2(cells)),
             "Of the sampling probabilities. The maximum is a uniform table: cosine sampling.");
    text_row("Effective", fmt::format("{:.1f} cells, peak {:.1f} x mean", summary.effective_cells, summary.peak),
             "2 to the power of the entropy; largest over mean probability.");
    text_row("Irradiance", fmt::format("{:.4g}", volume.mean_radiance * kPi),
             "Learned irradiance, root mean square of red, green and blue.");
}

/// Freezing and stepping of the whole field, and forgetting of this volume, before the next control of the row.
void draw_learning_buttons(ViewerModel& model) {
    if (!info_of(model.render().method()).learns) return;
    const bool is_frozen = model.status().field && model.status().field->is_frozen;
    ImGui::AlignTextToFramePadding();
    if (ImGui::SmallButton(is_frozen ? "continue###freeze" : "freeze###freeze"))
        model.render().control_learning(is_frozen ? LearningControl::Continue : LearningControl::Freeze);
    note_place("freeze");
    tooltip("Freezes the learned field of all volumes as it is after the present pass; the picture goes on. Or lets "
            "every pass train it again.");
    ImGui::SameLine();
    ImGui::BeginDisabled(!is_frozen);
    if (ImGui::SmallButton("step")) model.render().control_learning(LearningControl::Step);
    note_place("step");
    ImGui::EndDisabled();
    tooltip("One more pass trains the frozen field, with one update.");
    ImGui::SameLine();
    if (ImGui::SmallButton("forget volume")) model.render().forget_volume(model.selection().volume());
    note_place("forget volume");
    tooltip("This volume begins anew, as if it had never been trained; all others keep what they learned.");
    same_line_for(em(8.5f));
}

}  // namespace

void draw_volume_tab(ViewerModel& model) {
    if (model.selection().volume() == kNoVolume) {
        model.selection().hover_cell(-1);
        faint_text("Click a surface in the picture to see its learned incident radiance.");
        return;
    }
    ImGui::AlignTextToFramePadding();  // of the check box at the end of the row
    ImGui::Text("Radiance volume %d", model.selection().volume());
    ImGui::SameLine();
    if (ImGui::SmallButton("deselect")) {
        model.selection().deselect();
        return;
    }
    ImGui::SameLine();
    if (ImGui::SmallButton(model.selection().pins().contains(model.selection().volume()) ? "unpin" : "pin"))
        model.selection().toggle_pin();
    note_place("pin");
    tooltip("K: keeps the volume in view beside others, up to four, on the same scale.");
    same_line_for(em(6.0f));
    ImGui::Checkbox("true light", &model.window().cell_display.truth);
    tooltip("The light that reaches the volume, beside the learned one.");
    const VolumeInspection* volume = model.selection().inspection();
    if (volume == nullptr) {
        model.selection().hover_cell(-1);
        faint_text(info_of(model.render().method()).uses_field
                       ? "The field of this volume is shown after the present pass."
                       : fmt::format("This method has no field. Press {} to precompute one, or {} to learn one while "
                                     "rendering.",
                                     method_keys(&MethodInfo::precomputes), method_keys(&MethodInfo::learns))
                             .c_str());
        return;
    }
    CellDisplay& display = model.window().cell_display;
    draw_learning_buttons(model);
    draw_keeping(model.time());
    draw_choices(display);
    if (display.truth) model.selection().light().show();
    const std::shared_ptr<const VolumeInspection> past = model.time().inspection(model.selection().volume());
    if (past != nullptr) volume = past.get();
    draw_time(model, *volume);
    draw_volume_discs(model, *volume);
    draw_memory(model.time());
    if (display.truth) {
        const auto& guiding = model.frame()->snapshot.guiding;
        draw_truth(model.selection(), guiding ? &*guiding : nullptr);
        draw_figure_curves(model);
        ImGui::Separator();
    }
    draw_summary(*volume);
}

}  // namespace pl::ui
