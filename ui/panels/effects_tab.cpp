// The tab of effects: which the scene needs and why, and the kernel that serves them.
#include <string>

#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

/// With spaces for line breaks between effects.
std::string spaced(const std::string& kernel) {
    std::string text;
    for (const char letter : kernel) text += letter == '+' ? std::string(" + ") : std::string(1, letter);
    return text;
}

}  // namespace

void draw_effects_tab(const ViewerModel& model) {
    const EffectsModel& effects = model.effects();
    if (effects.rows().empty()) {
        faint_text("Nothing is rendered yet.");
        return;
    }
    text_row("Kernel", spaced(effects.kernel()), "The smallest compiled kernel that serves the needed effects.");
    ImGui::Separator();
    for (const EffectRow& row : effects.rows())
        text_row(row.name.c_str(), row.needed() ? row.reason : "not needed", "",
                 row.needed() ? colors::kAccent : colors::kFaint);
}

}  // namespace pl::ui
