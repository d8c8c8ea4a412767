#include "ui/plot/draw_run_table.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/plot/plot_widget.h"

namespace pl::ui {
namespace {

constexpr float kSampleEm = 1.2f;

struct RunColumn {
    const char* title;
    const char* tip;
    std::string (*text)(const RunRow&);
};

std::string backend_text(const RunRow& row) {
    std::string name = row.label.backend;
    for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    return name;
}
std::string light_text(const RunRow& row) { return row.label.next_event ? "on" : "off"; }
std::string start_text(const RunRow& row) { return row.label.warm ? "warm" : "cold"; }
std::string samples_text(const RunRow& row) {
    return row.samples < 1000.0 ? fmt::format("{:.0f}", row.samples) : short_number(row.samples);
}
std::string cost_text(const RunRow& row) {
    return row.seconds_per_sample > 0.0 ? short_seconds(row.seconds_per_sample) : "-";
}

constexpr RunColumn kBackEnd{"on", "The back end that renders.", backend_text};
constexpr RunColumn kStart{"start", "Warm: began with a learned field, whose cost is not in its seconds.",
                           start_text};

/// Those that tell the runs apart, or that every reader needs.
std::vector<RunColumn> columns_for(const std::vector<RunRow>& rows, float width) {
    std::vector<RunColumn> columns;
    if (std::ranges::any_of(rows, [](const RunRow& row) { return row.label.backend != "cpu"; }))
        columns.push_back(kBackEnd);
    columns.push_back({"light", "Light samples (key L): at each vertex a point on a light is sampled.", light_text});
    if (std::ranges::any_of(rows, [](const RunRow& row) { return row.label.warm; })) columns.push_back(kStart);
    columns.push_back({"spp", "Samples per pixel so far.", samples_text});
    constexpr float kLeastEm = 21.0f;
    if (width < em(kLeastEm)) return columns;  // the gain matters more
    columns.push_back(
        {"a sample", "Charged time for each sample per pixel of the whole picture, set-up included.", cost_text});
    return columns;
}

constexpr const char* kGainTip =
    "Time of the baseline over the time of the run, to the same error: above 1 the run is faster. The baseline is "
    "default, and in turns of other runs the second of them. In brackets 95 %: over runs of several seeds, else over "
    "the blocks of this picture; runs of other seeds differ by more. Undecided: the interval contains 1. Gray: the "
    "picture has many samples more than were measured.";

void header_cell(const char* title, const char* tip) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
    tooltip(tip);
}

void draw_header(const std::vector<RunColumn>& columns) {
    ImGui::TableNextRow();
    header_cell(
        "method",
        "Or what differs from its usual settings. Click on a row to hide or show its curve. Full lines: with light "
        "samples; dashed: without.");
    for (const RunColumn& column : columns) header_cell(column.title, column.tip);
    header_cell("gain", kGainTip);
}

ImU32 gain_color(const RunRow& row) {
    if (!row.gain) return colors::kFaint;
    const Verdict verdict = verdict_of(row.gain->net);
    if (verdict == Verdict::Faster) return colors::kGood;
    return verdict == Verdict::Slower ? colors::kWarning : colors::kText;
}

/// The statement, and its interval where there is room.
void draw_gain(const RunRow& row, bool is_old) {
    ImGui::TableNextColumn();
    std::string text = gain_text(row);
    if (const std::string interval = interval_text(row); !interval.empty()) {
        const std::string both = fmt::format("{} ({})", text, interval);
        if (ImGui::CalcTextSize(both.c_str()).x <= ImGui::GetContentRegionAvail().x) text = both;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, is_old ? colors::kFaint : gain_color(row));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

/// Sample of the line and name of the method. True if the row was clicked.
bool draw_method(const RunRow& row, const PlotLine* line, const std::string& remark) {
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::Selectable("##row", false, ImGuiSelectableFlags_SpanAllColumns);
    tooltip(remark.c_str());
    note_place(name_of(row.label).c_str());
    if (line != nullptr)
        draw_sample(*ImGui::GetWindowDrawList(), *line, {at.x, at.y + 0.5f * ImGui::GetTextLineHeight()},
                    em(kSampleEm));
    ImGui::SameLine(0.0f, 0.0f);
    ImGui::SetCursorScreenPos({at.x + em(kSampleEm + 0.3f), at.y});
    std::string name(row.label.details.empty() ? std::string(info_of(row.label.method).name) : row.label.details);
    if (row.seeds > 1) name += fmt::format(" x{}", row.seeds);
    const bool hidden = line != nullptr && line->hidden;
    ImGui::TextColored(to_vec4(hidden ? colors::kFaint : colors::kText), "%s", name.c_str());
    return clicked;
}

const PlotLine* line_of(const AccuracyModel& model, std::uint64_t run) {
    const auto line = std::ranges::find(model.lines(), run, &PlotLine::run);
    return line != model.lines().end() ? &*line : nullptr;
}

bool has_row(const AccuracyModel& model, std::uint64_t run) {
    return std::ranges::any_of(model.table().rows, [&](const RunRow& row) { return row.run == run; });
}

}  // namespace

void draw_run_table(AccuracyModel& model) {
    const RunTable& table = model.table();
    const std::vector<RunColumn> columns = columns_for(table.rows, ImGui::GetContentRegionAvail().x);
    std::uint64_t clicked = 0;
    const float start = ImGui::GetCursorPosY();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em(0.22f), 0.0f});
    if (!table.rows.empty() &&
        ImGui::BeginTable("runs", static_cast<int>(columns.size()) + 2, ImGuiTableFlags_SizingFixedFit)) {
        for (std::size_t i = 0; i <= columns.size(); ++i) ImGui::TableSetupColumn("");
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
        draw_header(columns);
        for (const RunRow& row : table.rows) {
            ImGui::TableNextRow();
            ImGui::PushID(static_cast<int>(row.run));
            const bool is_old = model.is_old(row);
            const std::string remark = is_old ? row.remark + "\n" + model.age_text(row) : row.remark;
            if (draw_method(row, line_of(model, row.run), remark)) clicked = row.run;
            for (const RunColumn& column : columns)
                text_cell(column.text(row), is_old ? colors::kFaint : colors::kText);
            draw_gain(row, is_old);
            ImGui::PopID();
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    if (!table.note.empty()) faint_text(table.note.c_str());
    // A header and two rows, or one and the note, have room from the start: what is below keeps its place.
    constexpr float kUsualLines = 3.0f;
    const float end = start + kUsualLines * ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().ItemSpacing.y;
    if (ImGui::GetCursorPosY() < end) ImGui::SetCursorPosY(end);
    if (clicked != 0) model.toggle_hidden(clicked);
}

void draw_older_runs(AccuracyModel& model) {
    const std::size_t older = model.table().older.size();
    if (older == 0) return;
    if (!section(fmt::format("{} older run{}###older runs", older, older == 1 ? "" : "s").c_str(), false)) return;
    draw_legend(model, [&](const PlotLine& line) { return !has_row(model, line.run); });
}

}  // namespace pl::ui
