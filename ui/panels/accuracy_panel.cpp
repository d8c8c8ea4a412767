#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"
#include "ui/plot/draw_plot.h"
#include "ui/plot/plot_widget.h"

namespace pl {
namespace {

constexpr float kPlotEm = 15.5f;
constexpr float kSmallestPlotEm = 9.0f;

/// Always there, above all that scrolls, and of the same size whoever wins.
void draw_headlines(const AccuracyModel& model) {
    for (const Headline& headline : model.headlines()) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = ImGui::GetTextLineHeight();
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y + 0.2f * height}, {at.x + em(0.5f), at.y + 0.9f * height}, to_imgui_color(headline.color));
        ImGui::SetCursorScreenPos({at.x + em(0.8f), at.y});
        ImGui::TextWrapped("%s", headline.text.c_str());
    }
}

void draw_metric_choice(AccuracyModel& model) {
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - em(10.0f), em(4.0f)));
    if (ImGui::BeginCombo("##metric", info_of(model.wanted_metric()).label)) {
        for (int i = 0; i < kErrorMetricCount; ++i) {
            const auto metric = static_cast<ErrorMetric>(i);
            if (ImGui::Selectable(info_of(metric).label, metric == model.wanted_metric())) model.set_metric(metric);
            tooltip(info_of(metric).what);
        }
        ImGui::EndCombo();
    }
    tooltip(info_of(model.wanted_metric()).what);
    ImGui::SameLine();
    const bool seconds = model.kind().axis == CostAxis::Seconds;
    if (ImGui::RadioButton("s", seconds)) model.set_axis(CostAxis::Seconds);
    tooltip("Over seconds charged: placing volumes, precomputing, learning and rendering. Measuring, saving and the "
            "window "
            "are on no clock.");
    ImGui::SameLine();
    if (ImGui::RadioButton("spp", !seconds)) model.set_axis(CostAxis::Samples);
    tooltip("Over samples per pixel.");
    ImGui::SameLine();
    if (ImGui::Button("Fit")) model.fit_view();
    tooltip("Show all curves of this picture; a double click on the plot does the same.");
}

std::string cost_text(double cost, CostAxis axis) {
    return axis == CostAxis::Seconds ? short_seconds(cost) : fmt::format("{:.0f} spp", cost);
}

/// The text of a column at the right of the legend's color.
void cell(const std::string& text, ImU32 color = colors::kText) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

/// What stands where nothing was measured: why.
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
    cell(name_of(run->label), to_imgui_color(color_of(run->label.method)));
    const bool at_error = model.cursor().kind == Cursor::Kind::EqualError;
    const std::optional<double>& shown = at_error ? row.cost : row.error;
    if (!shown)
        cell(missing_text(row, model), colors::kFaint);
    else
        cell(at_error ? cost_text(*shown, kind.axis) : fmt::format("{:.3g}", *shown));
    const CostAxis other = kind.axis == CostAxis::Seconds ? CostAxis::Samples : CostAxis::Seconds;
    cell(row.other_cost && shown ? cost_text(*row.other_cost, other) : "-");
    if (row.is_base)
        cell("default", colors::kFaint);
    else if (!row.ratio)
        cell("-", colors::kFaint);
    else
        cell(fmt::format("{:.2f}x", *row.ratio), *row.ratio >= 1.0 ? colors::kGood : colors::kWarning);
}

void draw_cursor_table(const AccuracyModel& model) {
    const Cursor& cursor = model.cursor();
    if (cursor.kind == Cursor::Kind::None) {
        faint_text(
            "Drag along the numbers below the plot for pictures at equal cost, along those at its left for pictures "
            "at equal error.");
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

std::string choice_text(const SideChoice& choice, const AccuracyModel& model) {
    if (choice.what == SideChoice::What::Reference) return "reference";
    const auto run = choice.what == SideChoice::What::Run ? find_run(model.runs(), choice.run) : nullptr;
    return run ? name_of(run->label) : "automatic";
}

void draw_side_choice(ViewerModel& model, bool second) {
    const SideChoice& now = second ? model.window().compare.b : model.window().compare.a;
    begin_row(second ? "B" : "A", "Automatic: A is the run in progress, B what it is measured against.");
    if (!ImGui::BeginCombo(second ? "##b" : "##a", choice_text(now, model.accuracy()).c_str())) return;
    const auto offer = [&](const std::string& name, const SideChoice& choice) {
        if (ImGui::Selectable(name.c_str(), choice == now)) model.choose_side(second, choice);
    };
    offer("automatic", {});
    for (const auto& run : model.accuracy().runs())
        if (run->label.picture == model.accuracy().picture())
            offer(fmt::format("{}##{}", name_of(run->label), run->number), {SideChoice::What::Run, run->number});
    if (model.reference() != nullptr) offer("reference", {SideChoice::What::Reference, 0});
    ImGui::EndCombo();
}

void draw_comparison(ViewerModel& model) {
    if (!section("Compare pictures", true)) return;
    int mode = static_cast<int>(model.window().compare.mode);
    if (choice_row("Mode", "Keys C and Shift+C; G flips to the other picture.", &mode,
                   "off\0split\0flip\0side by side\0difference\0error map\0\0"))
        model.set_compare_mode(static_cast<CompareMode>(mode));
    draw_side_choice(model, false);
    draw_side_choice(model, true);
    bool turns = model.turns();
    if (toggle_row(
            "In turns of equal time",
            "Key X: the present method and the one it is compared with render in turns A, B, B, A of equal charged "
            "time, each at half the speed.",
            &turns))
        model.set_turns(turns);
}

void draw_reference(ViewerModel& model) {
    if (const auto making = model.reference_progress()) {
        const float button = em(5.0f);
        ImGui::ProgressBar(static_cast<float>(making->share),
                           {ImGui::GetContentRegionAvail().x - button - em(0.5f), 0.0f}, making->detail.c_str());
        ImGui::SameLine();
        if (ImGui::Button("End", {button, 0.0f})) model.stop_reference();
        tooltip("Esc: what is there is stored and used, and can be gone on with.");
        return;
    }
    if (const ReferencePicture* reference = model.reference())
        faint_text(fmt::format("{}, noise {:.2g}", reference->label, reference->noise_relmse).c_str());
    if (wide_button(
            model.reference() != nullptr ? "Go on with the reference" : "Make the reference",
            "Key Ctrl+R. In two halves, on the CPU, with default path tracing and next-event estimation, at low "
            "priority. Rendering rests meanwhile, so that nothing that is measured gets slower. It is stored as "
            "'pathlight reference' does, in the folder references, and found again by what the picture shows."))
        model.make_reference();
}

void draw_footing(const AccuracyModel& model) {
    const LiveRunSet* set = model.set();
    if (set == nullptr) return;
    const double charged = set->charged_seconds;
    std::string text = fmt::format("pictures kept: {}B of {}B", short_number(static_cast<double>(set->picture_bytes)),
                                   short_number(static_cast<double>(set->picture_bytes_cap)));
    if (charged > 0.0)
        text +=
            fmt::format("; measuring took {:.2g} % beside the charged time", 100.0 * set->measure_seconds / charged);
    faint_text(text.c_str());
    tooltip("The band is of this run: two standard errors over its own blocks of 16 x 16 pixels. Where all pixels "
            "share what "
            "was learned, runs of other seeds differ by more: change the seed for runs whose interval the headline "
            "gives.");
}

}  // namespace

void draw_accuracy_panel(ViewerModel& model, const Layout& layout) {
    WindowState& window = model.window();
    AccuracyModel& accuracy = model.accuracy();
    begin_fixed_window("accuracy", layout.accuracy,
                       ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_headlines(accuracy);
    ImGui::BeginChild("scrolled", {0.0f, 0.0f}, false, window.over_plot ? ImGuiWindowFlags_NoScrollWithMouse : 0);
    draw_metric_choice(accuracy);
    // What a cursor tells should be seen without scrolling.
    const float rows = accuracy.rows().empty() ? 0.0f : static_cast<float>(accuracy.rows().size()) + 1.0f;
    const float room = ImGui::GetContentRegionAvail().y - em(6.0f) - rows * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::clamp(room, em(kSmallestPlotEm), em(kPlotEm));
    if (draw_accuracy_plot(accuracy, window.plot_drag, window.plot, height)) model.set_cursor(accuracy.cursor());
    window.over_plot = ImGui::IsItemHovered();
    draw_legend(accuracy);
    draw_cursor_table(accuracy);
    draw_comparison(model);
    draw_reference(model);
    draw_footing(accuracy);
    ImGui::EndChild();
    ImGui::End();
}

}  // namespace pl
