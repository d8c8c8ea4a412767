#include "ui/panels/widgets.h"

#include <cmath>

#include <fmt/format.h>

namespace pl {
namespace {

constexpr float kLabelEm = 6.4f;

std::string hidden_label(const char* label) {
    return std::string("##") + label;
}

/// Keeps what is typed aside until the field is left: half a number must not place volumes anew.
class EditedNumber {
public:
    EditedNumber(const char* label, double value)
        : storage_(*ImGui::GetStateStorage()), number_id_(ImGui::GetID(label)), flag_id_(number_id_ + 1),
          value_(value) {}

    double value() const { return pending() ? static_cast<double>(storage_.GetFloat(number_id_)) : value_; }

    /// After the control was drawn. True when `number` is complete and new.
    bool finish(bool changed, double number) {
        if (changed) {
            storage_.SetFloat(number_id_, static_cast<float>(number));
            storage_.SetBool(flag_id_, true);
            return false;
        }
        if (!pending() || ImGui::IsItemActive())
            return false;
        storage_.SetBool(flag_id_, false);
        return number != value_;
    }

private:
    bool pending() const { return storage_.GetBool(flag_id_); }

    ImGuiStorage& storage_;
    ImGuiID number_id_;
    ImGuiID flag_id_;
    double value_;
};

} // namespace

void tooltip(const char* text) {
    if (text == nullptr || *text == '\0' || !ImGui::IsItemHovered())
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(em(22.0f));
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void begin_row(const char* label, const char* tip) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    tooltip(tip);
    ImGui::SameLine(em(kLabelEm));
    ImGui::SetNextItemWidth(-1.0f);
}

void text_row(const char* label, const std::string& value, const char* tip, ImU32 color) {
    ImGui::TextDisabled("%s", label);
    tooltip(tip);
    ImGui::SameLine(em(kLabelEm));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("%s", value.c_str());
    ImGui::PopStyleColor();
    tooltip(tip);
}

bool slider_row(const char* label,
                const char* tip,
                float* value,
                float low,
                float high,
                float standard,
                const char* format,
                ImGuiSliderFlags flags) {
    begin_row(label, tip);
    bool changed = ImGui::SliderFloat(hidden_label(label).c_str(), value, low, high, format,
                                      flags | ImGuiSliderFlags_AlwaysClamp);
    tooltip(
        fmt::format("{}\nCtrl+click to type, right click for the default ({:.4g}).", tip, standard).c_str());
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
        *value = standard;
        changed = true;
    }
    return changed;
}

bool toggle_row(const char* label, const char* tip, bool* value) {
    const bool changed = ImGui::Checkbox(label, value);
    tooltip(tip);
    return changed;
}

bool int_row(const char* label, const char* tip, int* value, int step) {
    begin_row(label, tip);
    EditedNumber edited(label, static_cast<double>(*value));
    int number = static_cast<int>(std::lround(edited.value()));
    const bool changed = ImGui::InputInt(hidden_label(label).c_str(), &number, step, 10 * step);
    tooltip(tip);
    if (!edited.finish(changed, static_cast<double>(number)))
        return false;
    *value = number;
    return true;
}

bool double_row(const char* label, const char* tip, double* value, double step, const char* format) {
    begin_row(label, tip);
    EditedNumber edited(label, *value);
    double number = edited.value();
    const bool changed = ImGui::InputDouble(hidden_label(label).c_str(), &number, step, 10.0 * step, format);
    tooltip(tip);
    if (!edited.finish(changed, number))
        return false;
    *value = number;
    return true;
}

bool choice_row(const char* label, const char* tip, int* index, const char* labels) {
    begin_row(label, tip);
    const bool changed = ImGui::Combo(hidden_label(label).c_str(), index, labels);
    tooltip(tip);
    return changed;
}

bool wide_button(const char* label, const char* tip) {
    const bool pressed = ImGui::Button(label, {-1.0f, 0.0f});
    tooltip(tip);
    return pressed;
}

bool section(const char* title, bool open_at_first) {
    ImGui::PushStyleColor(ImGuiCol_Text, colors::kAccent);
    const bool open = ImGui::CollapsingHeader(title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopStyleColor();
    return open;
}

void faint_text(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colors::kFaint);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

std::string short_number(double value) {
    constexpr const char* kUnits[] = {"", " k", " M", " G", " T"};
    int unit = 0;
    while (std::fabs(value) >= 999.5 && unit < 4) {
        value /= 1000.0;
        ++unit;
    }
    return unit == 0 && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                   : fmt::format("{:.3g}{}", value, kUnits[unit]);
}

std::string short_seconds(double seconds) {
    if (seconds < 1.0)
        return fmt::format("{:.3g} ms", 1000.0 * seconds);
    if (seconds < 100.0)
        return fmt::format("{:.2f} s", seconds);
    return fmt::format("{:.0f} s", seconds);
}

} // namespace pl
