// The tab of effects: which the scene needs and why, the kernel that serves them, and the cost of each.
#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl {
namespace {

std::string cost_text(const EffectTrialCost& cost) {
    const PairedCost::Result& r = cost.result;
    std::string text = fmt::format("{} -> {}", short_seconds(r.base_seconds), short_seconds(r.other_seconds));
    if (r.pairs >= kFewestRuns)
        text += fmt::format(", x {:.3f} [{:.3f}, {:.3f}]", r.ratio.value, r.ratio.low, r.ratio.high);
    if (!cost.done) text += fmt::format(", {}/{}", r.pairs, PairedCost::kPairs);
    return text;
}

/// With spaces for line breaks between effects.
std::string spaced(const std::string& kernel) {
    std::string text;
    for (const char letter : kernel) text += letter == '+' ? std::string(" + ") : std::string(1, letter);
    return text;
}

/// The cost of a kernel that serves these effects too.
void draw_cost(ViewerModel& model, FeatureSet forced) {
    const EffectsModel& effects = model.effects().table();
    if (effects.kernel_with(forced) == effects.kernel()) {
        faint_text("The same kernel: no cost.");
    } else if (const EffectTrialCost* cost = effects.cost_of(forced)) {
        text_line(cost_text(*cost).c_str(), colors::kText);
        tooltip(
            "Time of a pass of this picture without and with the effect: means over pairs, their ratio and its 95 % "
            "interval. Effects of the same kernel cost the same.");
    } else if (model.effects().measuring() == forced) {
        faint_text("measuring passes of both kernels in turns");
    }
}

void draw_measure_button(ViewerModel& model, FeatureSet forced, const std::string& name) {
    const bool is_running = model.effects().measuring() == forced;
    const bool is_other = model.effects().table().kernel_with(forced) != model.effects().table().kernel();
    if (!is_other && !is_running) return;
    const std::string label = fmt::format("{}##{}", is_running ? "stop" : "measure", name);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - em(4.6f));
    if (ImGui::SmallButton(label.c_str())) {
        if (is_running)
            model.effects().stop();
        else
            model.effects().measure(forced);
    }
    note_place(("measure " + name).c_str());
    tooltip("Times passes without and with the effect in turns on the running picture, which stays the same.");
}

void draw_effect(ViewerModel& model, const EffectRow& row) {
    const FeatureSet forced = model.render().settings().forced_effects;
    bool on = row.needed() || forced.has(row.feature);
    ImGui::BeginDisabled(row.needed());
    const bool changed = toggle_row(
        row.name.c_str(), "Forces a kernel that serves this effect; the picture stays the same to the bit.", &on);
    ImGui::EndDisabled();
    if (changed) model.render().set_forced_effects({forced.bits ^ row.with().bits});
    if (!row.needed()) draw_measure_button(model, row.with(), row.name);
    const float indent = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::Indent(indent);
    if (row.needed())
        text_line(("needed: " + row.reason).c_str(), colors::kAccent);
    else
        draw_cost(model, row.with());
    ImGui::Unindent(indent);
}

}  // namespace

void draw_effects_tab(ViewerModel& model) {
    const EffectsModel& effects = model.effects().table();
    if (effects.rows().empty()) {
        faint_text("Nothing is rendered yet.");
        return;
    }
    text_row("Kernel", spaced(effects.kernel()), "The smallest compiled kernel that serves the needed effects.");
    const FeatureSet forced = model.render().settings().forced_effects;
    if (const std::string kernel = effects.kernel_with(forced); kernel != effects.kernel())
        text_row("In use", spaced(kernel), "The kernel that serves the forced effects too.");
    bool all = forced.covers(kEveryFeature);
    if (toggle_row("all effects", "Forces every effect.", &all))
        model.render().set_forced_effects(all ? kEveryFeature : FeatureSet{});
    draw_measure_button(model, kEveryFeature, "all effects");
    draw_cost(model, kEveryFeature);
    ImGui::Separator();
    for (const EffectRow& row : effects.rows()) draw_effect(model, row);
}

}  // namespace pl
