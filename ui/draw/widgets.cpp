#include "ui/draw/widgets.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/value_text.h"

namespace pl::ui {
namespace {

constexpr float kLabelEm = 6.4f;

std::string hidden_label(const char* label) { return std::string("##") + label; }

bool begin_list(const char* label, const char* tip, const char* shown) {
    const bool open = ImGui::BeginCombo(hidden_label(label).c_str(), shown);
    if (!open) end_row(label, tip);
    return open;
}

/// Keeps typed numbers until the field is left: half a number must not restart the placement of volumes.
template <std::size_t N>
class EditedNumbers {
public:
    EditedNumbers(const char* label, const std::array<float, N>& now)
        : storage_(*ImGui::GetStateStorage()), flag_(ImGui::GetID(label)), now_(now) {}

    /// The numbers in the control.
    std::array<float, N> shown() const {
        if (!storage_.GetBool(flag_)) return now_;
        std::array<float, N> values;
        for (std::size_t i = 0; i < N; ++i) values[i] = storage_.GetFloat(key(i));
        return values;
    }

    /// After the control was drawn. True if the numbers are complete and new.
    bool finish(bool changed, const std::array<float, N>& values) {
        if (changed) {
            for (std::size_t i = 0; i < N; ++i) storage_.SetFloat(key(i), values[i]);
            storage_.SetBool(flag_, true);
            return false;
        }
        if (!storage_.GetBool(flag_) || ImGui::IsItemActive()) return false;
        storage_.SetBool(flag_, false);
        return values != now_;
    }

private:
    ImGuiID key(std::size_t i) const { return flag_ + 1 + static_cast<ImGuiID>(i); }

    ImGuiStorage& storage_;
    ImGuiID flag_;
    std::array<float, N> now_;
};

/// Draws the word over the number of the last field, whose two step buttons are at its right, unless it is being typed.
void cover_zero(const char* word) {
    if (ImGui::IsItemActive()) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float buttons = 2.0f * (ImGui::GetFrameHeight() + style.ItemInnerSpacing.x);
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high{ImGui::GetItemRectMax().x - buttons, ImGui::GetItemRectMax().y};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(low, high, true);
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_WindowBg));  // the field's own ground is see-through
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), style.FrameRounding);
    list.AddText({low.x + style.FramePadding.x, low.y + style.FramePadding.y}, colors::kFaint, word);
    list.PopClipRect();
}

}  // namespace

void begin_fixed_window(const char* name, const Rect& place, int extra_flags) {
    ImGui::SetNextWindowPos({place.x, place.y});
    ImGui::SetNextWindowSize({place.width, place.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | extra_flags);
    ImGui::PopStyleVar();
    note_place(name, place);
}

void fill_fan(ImDrawList& list, std::span<const ImVec2> center_and_border, ImU32 color) {
    const auto count = static_cast<int>(center_and_border.size());
    if (count < 3) return;
    const ImVec2 uv = ImGui::GetFontTexUvWhitePixel();
    list.PrimReserve(3 * (count - 1), count);
    const auto first = static_cast<unsigned int>(list._VtxCurrentIdx);
    for (int i = 1; i < count; ++i) {
        const int next = i + 1 < count ? i + 1 : 1;
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first));
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first + static_cast<unsigned int>(i)));
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first + static_cast<unsigned int>(next)));
    }
    // Half a pixel larger: software renderers leave pinholes between triangles.
    constexpr float kOverlap = 0.5f;
    const ImVec2 center = center_and_border[0];
    for (const ImVec2& point : center_and_border) {
        const Vec2f out{point.x - center.x, point.y - center.y};
        const float length = glm::length(out);
        const float scale = length > 0.0f ? 1.0f + kOverlap / length : 1.0f;
        list.PrimWriteVtx({center.x + scale * out.x, center.y + scale * out.y}, uv, color);
    }
}

void text_cell(const std::string& text, ImU32 color) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

namespace {

constexpr float kTooltipEm = 22.0f;

/// Beside the panel of the last item, at its height; of a bar across the window below or above it.
void place_tooltip() {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float gap = em(0.4f);
    const float needed = em(kTooltipEm + 1.5f);
    const bool is_low = low.y > 0.5f * screen.y;
    // Nor does it cover the card over the picture.
    const float y = is_low ? high.y : std::max(low.y, gui_memory().top_card_end + gap);
    if (corner.x + size.x + needed <= screen.x)
        ImGui::SetNextWindowPos({corner.x + size.x + gap, y}, ImGuiCond_Always, {0.0f, is_low ? 1.0f : 0.0f});
    else if (corner.x >= needed)
        ImGui::SetNextWindowPos({corner.x - gap, y}, ImGuiCond_Always, {1.0f, is_low ? 1.0f : 0.0f});
    else
        ImGui::SetNextWindowPos(
            {std::clamp(low.x, 0.0f, std::max(screen.x - needed, 0.0f)), is_low ? low.y - gap : high.y + gap},
            ImGuiCond_Always, {0.0f, is_low ? 1.0f : 0.0f});
}

}  // namespace

void begin_tooltip() {
    place_tooltip();
    ImGui::BeginTooltip();
}

void end_tooltip() {
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ImGui::EndTooltip();
    note_place("tooltip", {corner.x, corner.y, size.x, size.y});
}

void tooltip(const char* text) {
    constexpr float kRestSeconds = 0.4f;  // a moving pointer should not open tooltips on its way
    if (*text == '\0' || !ImGui::IsItemHovered() || ImGui::IsMouseDown(ImGuiMouseButton_Left) ||
        gui_memory().pointer_rest_seconds < kRestSeconds)
        return;
    begin_tooltip();
    wrapped_text(text, em(kTooltipEm));
    end_tooltip();
}

void note_place(const char* label) {
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    if (high.x > ImGui::GetWindowPos().x + ImGui::GetWindowWidth()) gui_memory().cut += fmt::format("{}; ", label);
    note_place(label, {low.x, low.y, high.x - low.x, high.y - low.y});
}

void note_place(const char* label, const Rect& place) { gui_memory().places[label] = place; }

void end_row(const char* label, const char* tip) {
    note_place(label);
    tooltip(tip);
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
    ImGui::SameLine(std::max(em(kLabelEm), ImGui::CalcTextSize(label).x + em(0.8f)));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    // A tooltip has no width at which text could wrap.
    const bool wraps = ImGui::GetContentRegionAvail().x > em(3.0f);
    if (wraps)
        wrapped_text(value.c_str());
    else
        ImGui::TextUnformatted(value.c_str());
    ImGui::PopStyleColor();
    tooltip(tip);
}

bool slider_row(const char* label, const char* tip, float* value, const SliderRange& range) {
    begin_row(label, tip);
    bool changed = ImGui::SliderFloat(hidden_label(label).c_str(), value, range.low, range.high, range.format,
                                      range.flags | ImGuiSliderFlags_AlwaysClamp);
    note_place(label);
    tooltip(
        fmt::format("{}\nCtrl+click to type, right click for the default ({:.4g}).", tip, range.standard).c_str());
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
        *value = range.standard;
        changed = true;
    }
    return changed;
}

void same_line_for(float width) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

bool toggle_row(const char* label, const char* tip, bool* value) {
    const bool changed = ImGui::Checkbox(label, value);
    end_row(label, tip);
    return changed;
}

bool int_row(const char* label, const char* tip, int* value, int step, const char* zero_word) {
    begin_row(label, tip);
    EditedNumbers<1> edited(label, {static_cast<float>(*value)});
    int number = static_cast<int>(edited.shown()[0]);
    const bool changed = ImGui::InputInt(hidden_label(label).c_str(), &number, step, 10 * step);
    if (number == 0 && zero_word != nullptr) cover_zero(zero_word);
    end_row(label, tip);
    if (!edited.finish(changed, {static_cast<float>(number)})) return false;
    *value = number;
    return true;
}

bool double_row(const char* label, const char* tip, double* value, double step, const char* format,
                const char* zero_word) {
    begin_row(label, tip);
    EditedNumbers<1> edited(label, {static_cast<float>(*value)});
    auto number = static_cast<double>(edited.shown()[0]);
    const bool changed = ImGui::InputDouble(hidden_label(label).c_str(), &number, step, 10.0 * step, format);
    if (number == 0.0 && zero_word != nullptr) cover_zero(zero_word);
    end_row(label, tip);
    if (!edited.finish(changed, {static_cast<float>(number)})) return false;
    *value = number;
    return true;
}

bool size_row(const char* label, const char* tip, int* width, int* height) {
    begin_row(label, tip);
    EditedNumbers<2> edited(label, {static_cast<float>(*width), static_cast<float>(*height)});
    const std::array<float, 2> shown = edited.shown();
    int numbers[2] = {static_cast<int>(shown[0]), static_cast<int>(shown[1])};
    const bool changed = ImGui::InputInt2(hidden_label(label).c_str(), numbers);
    end_row(label, tip);
    if (!edited.finish(changed, {static_cast<float>(numbers[0]), static_cast<float>(numbers[1])})) return false;
    *width = numbers[0];
    *height = numbers[1];
    return true;
}

bool point_row(const char* label, const char* tip, float* xyz) {
    begin_row(label, tip);
    EditedNumbers<3> edited(label, {xyz[0], xyz[1], xyz[2]});
    std::array<float, 3> numbers = edited.shown();
    const bool changed = ImGui::InputFloat3(hidden_label(label).c_str(), numbers.data(), "%.4g");
    end_row(label, tip);
    if (!edited.finish(changed, numbers)) return false;
    std::copy(numbers.begin(), numbers.end(), xyz);
    return true;
}

bool choice_row(const char* label, const char* tip, int* index, const std::vector<std::string>& words, float width) {
    const auto current = static_cast<std::size_t>(*index);
    if (width > 0.0f)
        ImGui::SetNextItemWidth(width);
    else
        begin_row(label, tip);
    if (!begin_list(label, tip, current < words.size() ? words[current].c_str() : "")) return false;
    bool changed = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_chosen = ImGui::Selectable(words[i].c_str(), i == current);
        note_place(fmt::format("{}: {}", label, words[i]).c_str());
        if (!is_chosen || i == current) continue;
        *index = static_cast<int>(i);
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

void range_controls(RangeRule& rule) {
    bool logarithmic = rule.scale == ColorScale::Logarithmic;
    if (ImGui::Checkbox("log", &logarithmic)) rule.scale = logarithmic ? ColorScale::Logarithmic : ColorScale::Linear;
    end_row("log", "Logarithmic colors, over at most three decades.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::DragFloatRange2("##range", &rule.low_percent, &rule.high_percent, 0.2f, 0.0f, 100.0f, "%.0f %%", "%.0f %%",
                           ImGuiSliderFlags_AlwaysClamp);
    tooltip("Colors run from one percentile of the values to the other. Drag the ends; Ctrl+click to type; right "
            "click for all values.");
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) rule = {.scale = rule.scale};
}

bool color_row(const char* label, const char* tip, float* rgb) {
    begin_row(label, tip);
    const bool changed = ImGui::ColorEdit3(hidden_label(label).c_str(), rgb,
                                           ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions);
    end_row(label, tip);
    return changed;
}

bool begin_choice_row(const char* label, const char* tip, const char* shown) {
    begin_row(label, tip);
    return begin_list(label, tip, shown);
}

bool wide_button(const char* label, const char* tip) {
    const bool pressed = ImGui::Button(label, {-1.0f, 0.0f});
    end_row(label, tip);
    return pressed;
}

bool section(const char* title, bool open_at_first) {
    ImGui::PushStyleColor(ImGuiCol_Text, colors::kAccent);
    const bool open = ImGui::CollapsingHeader(title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopStyleColor();
    note_place(title);
    return open;
}

std::string text_in_lines(std::string_view text, float width) {
    ImFont& font = *ImGui::GetFont();
    return broken_at_spaces(text, width, [&](std::string_view part) {
        return font.CalcTextSizeA(ImGui::GetFontSize(), FLT_MAX, 0.0f, part.data(), part.data() + part.size()).x;
    });
}

void wrapped_text(const char* text, float width) {
    const float room = width > 0.0f ? width : std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room);
    ImGui::TextUnformatted(text_in_lines(text, room).c_str());
    ImGui::PopTextWrapPos();
}

void text_line(const char* text, ImU32 color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    wrapped_text(text);
    ImGui::PopStyleColor();
}

void faint_text(const char* text) { text_line(text, colors::kFaint); }

}  // namespace pl::ui
