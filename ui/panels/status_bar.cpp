#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"

namespace pl {
namespace {

/// Items in one line with bars between them.
class StatusLine {
public:
    void add(const std::string& text, const char* tip, ImU32 color = colors::kText) {
        if (!first_) {
            ImGui::SameLine(0.0f, em(0.5f));
            ImGui::TextDisabled("|");
            ImGui::SameLine(0.0f, em(0.5f));
        }
        first_ = false;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
        tooltip(tip);
    }

private:
    bool first_ = true;
};

void draw_counts(StatusLine& line, const ViewerModel& model) {
    const PublishedFrame* frame = model.frame();
    if (frame == nullptr) return;
    const PassCounters& counters = frame->snapshot.counters;
    if (const auto& field = model.status().field) {
        line.add(fmt::format("{} learned", field->passes),
                 "Times that tables were published. Camera moves keep them.");
        if (field->lookup_misses > 0)
            line.add(fmt::format("{} misses", short_number(static_cast<double>(field->lookup_misses))),
                     "Surface points that no radiance volume serves: sampled by reflectance alone.", colors::kFaint);
    }
    line.add(fmt::format("{} invalid", counters.invalid_samples),
             "Samples that were NaN, infinite or negative. They are dropped.",
             counters.invalid_samples > 0 ? colors::kWarning : colors::kFaint);
    line.add(fmt::format("{} escaped", short_number(static_cast<double>(counters.path.escaped))),
             "Paths that left the scene. 0 in a closed one.", colors::kFaint);
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

void draw_status_bar(const ViewerModel& model, const Layout& layout) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.6f), em(0.35f)});
    begin_fixed_window("status", layout.status, ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    StatusLine line;
    const WorkerState state = model.status().state;
    line.add(name_of(state), "What the render thread does.",
             state == WorkerState::Failed ? colors::kError
                                          : (state == WorkerState::Rendering ? colors::kGood : colors::kWarning));
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
