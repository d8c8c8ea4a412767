#include "ui/draw/layout.h"

#include <algorithm>
#include <cmath>

namespace pl::ui {
namespace {

// In multiples of the font's height. Panels shrink for the picture as far as their text allows.
constexpr float kLeftEm = 18.0f;
constexpr float kRightEm = 25.0f;
constexpr float kSmallestLeftEm = 16.0f;
constexpr float kSmallestRightEm = 18.0f;
constexpr float kReadableRightEm = 24.0f;  ///< all titles of the tabs
constexpr float kGoodViewEm = 36.0f;
constexpr float kSmallestViewEm = 18.0f;
constexpr float kAccuracyShare = 0.66f;       ///< of the height at the right
constexpr float kSmallAccuracyShare = 0.45f;  ///< beside a tab with discs
constexpr float kSmallestTabsEm = 8.0f;
constexpr float kSmallestAccuracyEm = 10.0f;
constexpr float kRunTableEm = 4.5f;         ///< where a selected volume needs the height
constexpr float kDetailEm = 17.0f;          ///< of its numbers down to the discs
constexpr float kWholePlotEm = 18.5f;       ///< of the accuracy panel: the table of some runs above a whole plot
constexpr float kMostForPlotShare = 0.56f;  ///< of the height at the right
constexpr float kBarEm = 1.75f;             ///< height of menu and status bar
constexpr float kBorderEm = 0.5f;
/// A picture that fills more than this share of the view is not stretched: stretching blurs.
constexpr float kNearlyFull = 0.95f;

float border_pixels(float em) { return std::round(kBorderEm * em); }

/// The least width of the right side that a drag can give, with `room` for panels and picture.
float least_chosen_right(float room, float em) {
    const float most = room - (kSmallestLeftEm + kSmallestViewEm) * em;
    return std::clamp(most, kSmallestRightEm * em, kReadableRightEm * em);
}

/// Of the left and of the right side; `room` is the width of the window without borders.
std::array<float, 2> panel_widths(float room, float em, const PanelChoice& choice) {
    const float least_left = choice.settings ? kSmallestLeftEm * em : 0.0f;
    float least_right = 0.0f;
    const bool is_automatic = choice.settings_em == 0.0f && choice.right_em == 0.0f;
    if (choice.right) least_right = is_automatic ? kSmallestRightEm * em : least_chosen_right(room, em);
    const auto chosen = [&](float size_em, float least, float others) {
        return std::clamp(size_em * em, least, std::max(room - others - kSmallestViewEm * em, least));
    };
    const bool keeps_left = choice.settings && choice.settings_em > 0.0f;
    const bool keeps_right = choice.right && choice.right_em > 0.0f;
    const float first_left = keeps_left ? chosen(choice.settings_em, least_left, least_right) : least_left;
    const float good_view = kGoodViewEm * em;
    float right = std::clamp(room - first_left - good_view, least_right, std::max(kRightEm * em, least_right));
    if (keeps_right) right = chosen(choice.right_em, least_right, first_left);
    if (!choice.right) right = 0.0f;
    float left = first_left;
    if (choice.settings && !keeps_left) left = std::clamp(room - right - good_view, least_left, kLeftEm * em);
    const float most = std::max(0.5f * room, 0.0f);
    return {std::min(std::round(left), most), std::min(std::round(right), most)};
}

/// Height of the accuracy panel, if both parts of the right side are open.
float accuracy_height(float height, float em, const PanelChoice& choice, bool detail) {
    const float least = std::min((detail ? kRunTableEm : kSmallestAccuracyEm) * em, 0.5f * height);
    const float most = height - std::min(kSmallestTabsEm * em, 0.5f * height);
    const float standard = std::max((detail ? kSmallAccuracyShare : kAccuracyShare) * height,
                                    std::min(kWholePlotEm * em, kMostForPlotShare * height));
    const float automatic = detail ? std::min(standard, height - kDetailEm * em) : standard;
    const float wanted = choice.accuracy_share > 0.0f ? choice.accuracy_share * height : automatic;
    return std::round(std::clamp(wanted, least, std::max(most, least)));
}

/// Splits `side`, whose height holds tabs, border and accuracy panel.
void split_right_side(Layout& layout, const Rect& side, float em, const PanelChoice& choice, bool detail) {
    const float border = std::min(border_pixels(em), side.height);
    const float room = side.height - border;
    const bool has_tabs = choice.tabs || !choice.accuracy;
    float below = has_tabs ? 0.0f : room;
    if (choice.accuracy && has_tabs) below = accuracy_height(room, em, choice, detail);
    const float above = room - below;
    if (has_tabs) layout.right = {side.x, side.y, side.width, above};
    layout.accuracy_border = {side.x, side.y + above, side.width, border};
    if (choice.accuracy) layout.accuracy = {side.x, side.y + above + border, side.width, below};
}

}  // namespace

Layout make_layout(float width, float height, float em, const PanelChoice& asked, bool detail) {
    Layout layout;
    layout.panels = asked.shown;
    layout.one_side = width - 2.0f * border_pixels(em) < (kSmallestLeftEm + kSmallestViewEm + kSmallestRightEm) * em;
    PanelChoice choice = asked;
    choice.settings = asked.shows_settings(layout.one_side);
    choice.right = asked.shows_right(layout.one_side);
    layout.view = {0.0f, 0.0f, width, height};
    layout.clear = layout.view;
    if (!choice.shown) return layout;

    const float bar = std::round(kBarEm * em);
    const float middle = std::max(height - 2.0f * bar, 1.0f);
    const float border = std::min(border_pixels(em), 0.25f * width);
    const auto [left, right] = panel_widths(width - 2.0f * border, em, choice);
    layout.menu = {0.0f, 0.0f, width, bar};
    layout.status = {0.0f, height - bar, width, bar};
    if (choice.settings) layout.left = {0.0f, bar, left, middle};
    layout.settings_border = {left, bar, border, middle};
    layout.right_border = {width - right - border, bar, border, middle};
    if (choice.right) split_right_side(layout, {width - right, bar, right, middle}, em, choice, detail);
    layout.clear = {left + border, bar, width - left - right - 2.0f * border, middle};
    const bool floating = layout.clear.width < kSmallestViewEm * em;
    layout.view = floating ? Rect{0.0f, bar, width, middle} : layout.clear;
    return layout;
}

PanelChoice drag_border(PanelChoice choice, Border border, Vec2f pointer, const Layout& layout, float em) {
    const float spare = std::max(layout.clear.width - kSmallestViewEm * em, 0.0f);
    const float half = 0.5f * layout.settings_border.width;
    const auto chosen = [&](float pixels, float now, float least) {
        return std::clamp(pixels, least, std::max(now + spare, least)) / em;
    };
    if (border == Border::Settings) {
        choice.settings_em = chosen(pointer.x - half, layout.left.width, kSmallestLeftEm * em);
    } else if (border == Border::Right) {
        const float room = layout.menu.width - 4.0f * half;
        const float now = layout.menu.width - layout.right_border.x - layout.right_border.width;
        choice.right_em = chosen(layout.menu.width - pointer.x - half, now, least_chosen_right(room, em));
    } else {
        const float room = layout.right.height + layout.accuracy.height;
        const float below = layout.accuracy.y + layout.accuracy.height - pointer.y - half;
        constexpr float kLeastShare = 0.01f;  // 0 is automatic
        choice.accuracy_share = std::clamp(below / std::max(room, 1.0f), kLeastShare, 1.0f);
    }
    return choice;
}

PanelChoice free_border(PanelChoice choice, Border border) {
    if (border == Border::Settings) choice.settings_em = 0.0f;
    if (border == Border::Right) choice.right_em = 0.0f;
    if (border == Border::Accuracy) choice.accuracy_share = 0.0f;
    return choice;
}

Rect place_image(const Rect& view, int width, int height) {
    if (width < 1 || height < 1) return {};
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    float scale = std::min(view.width / w, view.height / h);
    if (scale >= 1.0f && scale * kNearlyFull <= 1.0f) scale = 1.0f;
    const float shown_w = std::max(std::round(w * scale), 1.0f);
    const float shown_h = std::max(std::round(h * scale), 1.0f);
    return {std::floor(view.x + 0.5f * (view.width - shown_w)), std::floor(view.y + 0.5f * (view.height - shown_h)),
            shown_w, shown_h};
}

glm::ivec2 fit_image(const Rect& view, int width, int height) {
    constexpr float kMinWidth = 64.0f;
    const float shape = static_cast<float>(std::max(height, 1)) / static_cast<float>(std::max(width, 1));
    const float w = std::max(std::floor(std::min(view.width, view.height / shape)), kMinWidth);
    return {static_cast<int>(w), std::max(static_cast<int>(std::lround(w * shape)), 1)};
}

}  // namespace pl::ui
