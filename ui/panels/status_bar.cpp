#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"

namespace pl {
namespace {

/// Items in one line with bars between them.
class StatusLine {
public:
    /// True if it was clicked.
    bool add(const std::string& text, const char* tip, ImU32 color = colors::kText) {
        if (!first_) {
            ImGui::SameLine(0.0f, em(0.5f));
            ImGui::TextDisabled("|");
            ImGui::SameLine(0.0f, em(0.5f));
        }
        first_ = false;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
        const bool is_clicked = ImGui::IsItemClicked();
        tooltip(tip);
        return is_clicked;
    }

private:
    bool first_ = true;
};

void draw_counts(StatusLine& line, const ViewerModel& model) {
    if (model.frame() == nullptr) return;
    if (const auto& field = model.status().field)
        line.add(fmt::format("{} learned", field->passes),
                 "Passes that were learned from. Camera moves keep what was learned.");
}

/// What went wrong, each kind alone; a click shows where.
void draw_diagnostics(StatusLine& line, ViewerModel& model) {
    if (model.frame() == nullptr) return;
    const DiagnosticCounts counts = counted_diagnostics(model.frame()->snapshot);
    bool is_clicked = false;
    bool is_sound = true;
    for (const DiagnosticInfo& diagnostics : all_diagnostics()) {
        const std::uint64_t count = counts[static_cast<std::size_t>(diagnostics.id)];
        if (count == 0) continue;
        is_sound = false;
        const std::string tip = fmt::format("{}\nA click shows where (T).", diagnostics.meaning);
        is_clicked |= line.add(fmt::format("{} {}", short_number(static_cast<double>(count)), diagnostics.label),
                               tip.c_str(), colors::kWarning);
        note_place(std::string(diagnostics.label).c_str());
    }
    if (is_sound) {
        is_clicked |=
            line.add("no diagnostics",
                     "No sample was invalid, no path left a closed scene, every surface point found its radiance "
                     "volume, no record was too bright.",
                     colors::kFaint);
        note_place("no diagnostics");
    }
    if (is_clicked) model.toggle_diagnostics();
}

std::string samples_text(const ViewerModel& model) {
    const SampleLimits& limits = model.limits();
    std::string text = limits.spp > 0 ? fmt::format("{}/{} spp", model.status().passes, limits.spp)
                                      : fmt::format("{} spp", model.status().passes);
    text += limits.seconds > 0.0 ? fmt::format(" | {:.1f}/{:g} s", model.status().seconds, limits.seconds)
                                 : fmt::format(" | {:.1f} s", model.status().seconds);
    return text;
}

}  // namespace

void draw_status_bar(ViewerModel& model, const Layout& layout) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.6f), em(0.35f)});
    begin_fixed_window("status", layout.status, ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    StatusLine line;
    const WorkerState state = model.status().state;
    line.add(name_of(state), "What the render thread does.",
             state == WorkerState::Failed ? colors::kError
                                          : (state == WorkerState::Rendering ? colors::kGood : colors::kWarning));
    draw_diagnostics(line, model);
    line.add(std::string(info_of(model.settings().method).label), "The method; keys 1, 2, 3.");
    if (model.frame() != nullptr)
        line.add(back_end_label(model.status().backend), model.frame()->backend.device.c_str());
    line.add(fmt::format("{}x{}", model.settings().width, model.settings().height), "Size of the picture.");
    line.add(samples_text(model),
             "Samples per pixel, and the time they took: placing, precomputing, learning and rendering.");
    line.add(fmt::format("{:.2f} Mpaths/s", model.mpaths_per_second()), "Camera paths per second of rendering.");
    draw_counts(line, model);
    ImGui::End();
}

}  // namespace pl
