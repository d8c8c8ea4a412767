// Rows of a panel: a label on the left, its value or control on the right, an explanation on hover.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/choice.h"
#include "core/plot/value_scale.h"
#include "ui/draw/draw_list.h"
#include "ui/draw/style.h"

namespace pl::ui {

/// Starts a window that fills `place` and cannot be moved. End it with ImGui::End().
void begin_fixed_window(const char* name, const Rect& place, int extra_flags = 0);

/// A polygon that is star-shaped around its first point; not antialiased, so that neighbors meet without a seam.
void fill_fan(ImDrawList& list, std::span<const ImVec2> center_and_border, ImU32 color);

/// Explains the last item while the pointer rests on it.
void tooltip(const char* text);
/// A tooltip of other content: beside the panel of the last item, so that it covers nothing that it is about.
void begin_tooltip();
void end_tooltip();

/// The next cell of a table.
void text_cell(const std::string& text, ImU32 color = colors::kText);

/// Records the rectangle of the last item, or another one, for scripts and the guided tour.
void note_place(const char* label);
void note_place(const char* label, const Rect& place);

/// Puts the label, and makes the next item fill the rest of the row.
void begin_row(const char* label, const char* tip);

/// After the item of such a row.
void end_row(const char* label, const char* tip);

/// A read-only value.
void text_row(const char* label, const std::string& value, const char* tip = "", ImU32 color = colors::kText);

struct SliderRange {
    float low;
    float high;
    float standard;      ///< value after a right click
    const char* format;  ///< of printf
    ImGuiSliderFlags flags = 0;
};

/// Ctrl+click to type, right click for the default. True if the value changed.
bool slider_row(const char* label, const char* tip, float* value, const SliderRange& range);

/// The next item goes on in this row if `width` is left there.
void same_line_for(float width);

bool toggle_row(const char* label, const char* tip, bool* value);

/// Typed numbers; a change takes effect when the field is left or Enter is pressed. Exact up to 2^24.
/// `zero_word` is shown in place of a 0 that means the lack of a limit or an automatic choice; null for plain zeros.
bool int_row(const char* label, const char* tip, int* value, int step, const char* zero_word = nullptr);
bool double_row(const char* label, const char* tip, double* value, double step, const char* format,
                const char* zero_word = nullptr);
bool size_row(const char* label, const char* tip, int* width, int* height);
bool point_row(const char* label, const char* tip, float* xyz);

/// One of several words. With a width it is the list alone, and scripts point at it by the label.
bool choice_row(const char* label, const char* tip, int* index, const std::vector<std::string>& words,
                float width = 0.0f);

/// `about`, then what the choices of an enumeration say of themselves.
template <Described Enum>
std::string choice_tip(std::string about) {
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>)
        if (!info.sentence.empty())
            about.append(" ").append(info.label).append(": ").append(info.sentence).append(".");
    return about;
}

/// One of them.
template <Described Enum>
bool choice_row(const char* label, const char* about, Enum* value, float width = 0.0f) {
    std::vector<std::string> labels;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>) labels.emplace_back(info.label);
    auto index = static_cast<int>(choice_index(*value));
    if (!choice_row(label, choice_tip<Enum>(about).c_str(), &index, labels, width)) return false;
    *value = kChoices<Enum>[static_cast<std::size_t>(index)].value;
    return true;
}

/// How colors follow from values: a check box for their logarithm, and the percentiles between which they run. Fills the row.
void range_controls(RangeRule& rule);

/// Linear red, green and blue in [0, 1].
bool color_row(const char* label, const char* tip, float* rgb);

/// Opens a list; if true, draw its items and end it with ImGui::EndCombo().
bool begin_choice_row(const char* label, const char* tip, const char* shown);

/// A full-width button.
bool wide_button(const char* label, const char* tip);

/// A section of the panel that can be folded.
bool section(const char* title, bool open_at_first);

/// The text in lines of the present font, see broken_at_spaces().
std::string text_in_lines(std::string_view text, float width);
/// Text that breaks lines, in the present color. Without a width it fills the rest of the row.
void wrapped_text(const char* text, float width = 0.0f);
/// The same in a color.
void text_line(const char* text, ImU32 color);
/// In the faint color.
void faint_text(const char* text);

}  // namespace pl::ui
