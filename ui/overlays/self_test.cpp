#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/widgets.h"
#include "ui/overlays/dialog.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

std::string margin_text(const SelfCheck& check) {
    if (check.tolerance <= 0.0) return "exact";
    return std::isfinite(check.used_share) ? fmt::format("{:.0f} % used", 100.0 * check.used_share) : "none";
}

void draw_check(const SelfCheck& check) {
    ImGui::TableNextRow();
    text_cell(check.passed ? "ok" : "FAILED", check.passed ? colors::kGood : colors::kError);
    text_cell(check.backend, colors::kFaint);
    text_cell(check.name);
    tooltip(check.criterion.c_str());
    text_cell(fmt::format("{:.6g}", check.expected));
    text_cell(fmt::format("{:.6g}", check.measured), check.passed ? colors::kText : colors::kError);
    text_cell(margin_text(check), colors::kFaint);
    tooltip("The deviation as a share of the tolerance; exact: no deviation is allowed.");
}

void draw_checks(const std::vector<SelfCheck>& checks, float height) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("checks", 6, kFlags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("back end");
    ImGui::TableSetupColumn("check", ImGuiTableColumnFlags_WidthStretch);
    for (const char* title : {"expected", "measured", "margin"}) ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    for (const SelfCheck& check : checks) draw_check(check);
    // Scrolls to new checks unless the user has scrolled up.
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0f);
    ImGui::EndTable();
}

ImU32 color_of(SelfTestRun::Outcome outcome) {
    switch (outcome) {
    case SelfTestRun::Outcome::Failed:
    case SelfTestRun::Outcome::Broken: return colors::kError;
    case SelfTestRun::Outcome::Passed: return colors::kGood;
    case SelfTestRun::Outcome::Stopped: return colors::kWarning;
    case SelfTestRun::Outcome::None:
    case SelfTestRun::Outcome::Running: break;
    }
    return colors::kText;
}

void draw_button(ViewerModel& model) {
    const SelfTestRun& test = model.self_test().run();
    const char* label =
        test.is_running() ? "Cancel" : (test.outcome() == SelfTestRun::Outcome::None ? "Run" : "Again");
    if (ImGui::Button(label, {em(6.0f), 0.0f})) {
        if (test.is_running())
            model.self_test().stop();
        else
            model.self_test().start();
    }
    note_place("self test");
    ImGui::SameLine();
    text_line(test.summary().c_str(), color_of(test.outcome()));
}

}  // namespace

void draw_self_test(ViewerModel& model, const Layout& layout) {
    if (!model.self_test().is_shown()) return;
    begin_dialog("Self test", model.self_test().is_shown(), layout, em(58.0f));
    faint_text("Renders small scenes with closed-form solutions on every available back end, as 'pathlight selftest' "
               "does. It "
               "takes about ten seconds per back end; rendering rests meanwhile.");
    draw_button(model);
    draw_checks(model.self_test().run().checks(), std::min(em(26.0f), screen_size(layout).y - em(14.0f)));
    ImGui::End();
}

}  // namespace pl::ui
