#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"
#include "ui/plot/draw_run_table.h"
#include "ui/plot/plot_widget.h"
#include "ui/plot/save_plot.h"

namespace pl::ui {
namespace {

constexpr float kPlotEm = 18.0f;
constexpr float kSmallestPlotEm = 12.0f;

void draw_metric_choice(AccuracyModel& model, PictureFiles& files) {
    const float width = std::max(ImGui::GetContentRegionAvail().x - em(13.5f), em(4.0f));
    const bool is_narrow = width < em(6.0f);  // no arrow beside the longest name
    ImGui::SetNextItemWidth(width);
    if (ImGui::BeginCombo("##metric", info_of(model.wanted_metric()).label,
                          is_narrow ? ImGuiComboFlags_NoArrowButton : 0)) {
        for (int i = 0; i < kErrorMetricCount; ++i) {
            const auto metric = static_cast<ErrorMetric>(i);
            if (ImGui::Selectable(info_of(metric).label, metric == model.wanted_metric())) model.set_metric(metric);
            tooltip(info_of(metric).meaning);
        }
        ImGui::EndCombo();
    }
    tooltip(info_of(model.wanted_metric()).meaning);
    ImGui::SameLine();
    const bool seconds = model.kind().axis == CostAxis::Seconds;
    if (ImGui::RadioButton("s", seconds)) model.set_axis(CostAxis::Seconds);
    tooltip(
        "Over charged seconds: placement, precomputation, learning and rendering, without measuring, saving and the "
        "window.");
    ImGui::SameLine();
    if (ImGui::RadioButton("spp", !seconds)) model.set_axis(CostAxis::Samples);
    tooltip("Over samples per pixel.");
    ImGui::SameLine();
    if (ImGui::Button("Fit")) model.fit_view();
    tooltip("Shows all curves of this picture, as a double click on the plot does.");
    ImGui::SameLine();
    if (ImGui::Button("Save")) files.save_plot(plot_svg(model), plot_csv(model));
    end_row("save plot", "The plot as SVG, and all points of its runs as CSV.");
}

std::string cost_text(double cost, CostAxis axis) {
    return axis == CostAxis::Seconds ? short_seconds(cost) : fmt::format("{:.0f} spp", cost);
}

/// The reason for a missing value.
std::string missing_text(const CursorRow& row, const AccuracyModel& model) {
    const CostAxis axis = model.kind().axis;
    if (model.cursor().kind == Cursor::Kind::EqualError) return "> " + cost_text(row.measured_until, axis);
    if (model.cursor().at > row.measured_until) return "ends at " + cost_text(row.measured_until, axis);
    return "from " + cost_text(row.measured_from, axis);
}

void draw_row(const CursorRow& row, const AccuracyModel& model) {
    const CurveKind& kind = model.kind();
    const auto run = find_run(model.runs(), row.run);
    if (!run) return;
    ImGui::TableNextRow();
    text_cell(name_of(run->label), to_text_color(run_color(model.runs(), run->label)));
    const bool at_error = model.cursor().kind == Cursor::Kind::EqualError;
    const std::optional<double>& shown = at_error ? row.cost : row.error;
    if (!shown)
        text_cell(missing_text(row, model), colors::kFaint);
    else
        text_cell(at_error ? cost_text(*shown, kind.axis) : fmt::format("{:.3g}", *shown));
    const CostAxis other = kind.axis == CostAxis::Seconds ? CostAxis::Samples : CostAxis::Seconds;
    text_cell(row.other_cost && shown ? cost_text(*row.other_cost, other) : "-");
    if (row.is_base)
        text_cell("baseline", colors::kFaint);
    else if (!row.ratio)
        text_cell("-", colors::kFaint);
    else
        text_cell(fmt::format("{:.2f}x", *row.ratio), *row.ratio >= 1.0 ? colors::kGood : colors::kWarning);
}

void draw_cursor_table(const AccuracyModel& model) {
    const Cursor& cursor = model.cursor();
    if (cursor.kind == Cursor::Kind::None) {
        faint_text(
            "Drag along the numbers below the plot for pictures at equal cost, along the numbers to its left for "
            "pictures at equal error.");
        return;
    }
    const bool at_error = cursor.kind == Cursor::Kind::EqualError;
    const char* metric = info_of(model.kind().metric).label;
    ImGui::TextUnformatted(at_error
                               ? fmt::format("At equal error: {} {:.3g}", metric, cursor.at).c_str()
                               : fmt::format("At equal cost: {}", cost_text(cursor.at, model.kind().axis)).c_str());
    if (!ImGui::BeginTable("rows", 4, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("run");
    ImGui::TableSetupColumn(at_error ? "reached after" : "error");
    ImGui::TableSetupColumn(model.kind().axis == CostAxis::Seconds ? "samples" : "seconds");
    ImGui::TableSetupColumn(at_error ? "sooner" : "less error");
    ImGui::TableHeadersRow();
    for (const CursorRow& row : model.rows()) draw_row(row, model);
    ImGui::EndTable();
}

std::string choice_text(const SideChoice& choice, const CompareControls& comparison) {
    if (choice.what == SideChoice::What::Reference) return "reference";
    if (choice.what == SideChoice::What::File && comparison.opened() != nullptr) return comparison.opened()->name;
    const auto run =
        choice.what == SideChoice::What::Run ? find_run(comparison.accuracy().runs(), choice.run) : nullptr;
    return run ? name_of(run->label) : "automatic";
}

void draw_side_choice(ViewerModel& model, bool second) {
    const CompareControls& comparison = model.comparison();
    const SideChoice& now = second ? comparison.state().b : comparison.state().a;
    const std::string label = second ? "B" : "A";
    if (!begin_choice_row(label.c_str(), "Automatic: A is the run in progress, B its baseline.",
                          choice_text(now, comparison).c_str()))
        return;
    const auto offer = [&](const std::string& name, const SideChoice& choice) {
        if (ImGui::Selectable(fmt::format("{}##{}", name, choice.run).c_str(), choice == now))
            model.comparison().choose_side(second, choice);
        note_place(fmt::format("{}: {}", label, name).c_str());
    };
    offer("automatic", {});
    for (const auto& run : comparison.accuracy().runs())
        if (run->label.picture == comparison.accuracy().picture())
            offer(name_of(run->label), {SideChoice::What::Run, run->number});
    if (model.references().current() != nullptr) offer("reference", {SideChoice::What::Reference, 0});
    if (const OpenedPicture* opened = comparison.opened()) offer(opened->name, {SideChoice::What::File, 0});
    ImGui::EndCombo();
}

void draw_comparison(ViewerModel& model) {
    if (!section("Compare pictures", true)) return;
    CompareMode mode = model.comparison().state().mode;
    if (choice_row("Mode", "Keys C and Shift+C; G flips to the other picture.", &mode))
        model.comparison().set_mode(mode);
    draw_side_choice(model, false);
    draw_side_choice(model, true);
    bool turns = model.comparison().in_turns();
    if (toggle_row(
            "In turns of equal time",
            "Key X: the present run and the one chosen as B, with all its settings, render in turns A, B, B, A of "
            "equal charged time, each at half the speed. Without a choice another method is B.",
            &turns))
        model.comparison().set_turns(turns);
}

void draw_reference(ViewerModel& model) {
    if (const auto making = model.references().progress()) {
        const float button = em(5.0f);
        ImGui::ProgressBar(static_cast<float>(making->share),
                           {ImGui::GetContentRegionAvail().x - button - em(0.5f), 0.0f}, making->detail.c_str());
        ImGui::SameLine();
        if (ImGui::Button("End", {button, 0.0f})) model.references().stop();
        tooltip("Esc: the samples so far are stored and used; the reference can be continued.");
        return;
    }
    const ReferencePicture* const reference = model.references().current();
    if (wide_button(
            reference != nullptr ? "Continue the reference" : "Render the reference",
            "Key Ctrl+R. Two independent halves, on the CPU at low priority, by default path tracing with light "
            "samples. Rendering rests meanwhile, so that no timed pass gets slower. Stored in the folder "
            "references "
            "like those of 'pathlight reference', and found again by scene, camera and size."))
        model.references().make();
    if (reference != nullptr)
        faint_text(fmt::format("{}, noise {:.2g}", reference->label, reference->noise_relmse).c_str());
}

void draw_footing(const AccuracyModel& model) {
    const LiveRunSet* set = model.set();
    if (set == nullptr) return;
    const double charged = set->charged_seconds;
    std::string text = fmt::format("pictures kept: {}B of {}B", short_number(static_cast<double>(set->picture_bytes)),
                                   short_number(static_cast<double>(set->picture_bytes_cap)));
    if (charged > 0.0)
        text += fmt::format("; measuring errors took another {:.2g} % of the charged time",
                            100.0 * set->measure_seconds / charged);
    faint_text(text.c_str());
    tooltip("The band is two standard errors of this run over its blocks of 16 x 16 pixels. Pixels share one learned "
            "field, so that runs with other seeds differ by more: render several seeds for the interval of the "
            "headline.");
}

}  // namespace

void draw_accuracy_panel(ViewerModel& model, const Layout& layout) {
    WindowState& window = model.window();
    AccuracyModel& accuracy = model.comparison().accuracy();
    note_place("accuracy panel", layout.accuracy);
    begin_fixed_window("accuracy", layout.accuracy,
                       ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_run_table(accuracy);  // above the scrolled part: always visible
    ImGui::BeginChild("scrolled", {0.0f, 0.0f}, false,
                      window.plot.has_wheel ? ImGuiWindowFlags_NoScrollWithMouse : 0);
    draw_metric_choice(accuracy, model.files().pictures());
    // The rows of a cursor should be visible without scrolling.
    const float rows = accuracy.rows().empty() ? 0.0f : static_cast<float>(accuracy.rows().size()) + 1.0f;
    const float room = ImGui::GetContentRegionAvail().y - em(6.0f) - rows * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::clamp(room, em(kSmallestPlotEm), em(kPlotEm));
    if (draw_accuracy_plot(accuracy, window.plot.drag, window.plot.frame, height))
        model.comparison().set_cursor(accuracy.cursor());
    window.plot.has_wheel = ImGui::IsItemHovered();
    draw_cursor_table(accuracy);
    draw_comparison(model);
    draw_reference(model);
    draw_footing(accuracy);
    draw_older_runs(accuracy);  // last: they come while others render, and move nothing
    ImGui::EndChild();
    ImGui::End();
}

}  // namespace pl::ui
