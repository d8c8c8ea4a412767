#include "ui/draw/layout.h"

#include <algorithm>
#include <cmath>

namespace pl {
namespace {

// In multiples of the font's height. Panels shrink for the picture as far as their text allows.
constexpr float kLeftEm = 18.0f;
constexpr float kRightEm = 25.0f;
constexpr float kSmallestLeftEm = 16.0f;
constexpr float kSmallestRightEm = 18.0f;
constexpr float kGoodViewEm = 36.0f;
constexpr float kSmallestViewEm = 18.0f;
constexpr float kAccuracyShare = 0.66f;       ///< of the height at the right
constexpr float kSmallAccuracyShare = 0.45f;  ///< beside a tab with discs
constexpr float kBarEm = 1.75f;               ///< height of menu and status bar
/// A picture that fills more than this share of the view is not stretched: stretching blurs.
constexpr float kNearlyFull = 0.95f;

}  // namespace

Layout make_layout(float width, float height, float em, bool panels, bool accuracy, bool detail) {
    Layout layout;
    layout.panels = panels;
    layout.view = {0.0f, 0.0f, width, height};
    layout.clear = layout.view;
    if (!panels) return layout;

    const float bar = std::round(kBarEm * em);
    const float middle = std::max(height - 2.0f * bar, 1.0f);
    const float spare = width - (kSmallestLeftEm + kSmallestRightEm + kGoodViewEm) * em;
    const float right = std::round(std::clamp(kSmallestRightEm * em + spare, kSmallestRightEm * em, kRightEm * em));
    const float rest = spare - (right - kSmallestRightEm * em);
    const float left = std::round(std::clamp(kSmallestLeftEm * em + rest, kSmallestLeftEm * em, kLeftEm * em));
    layout.menu = {0.0f, 0.0f, width, bar};
    layout.status = {0.0f, height - bar, width, bar};
    const float left_shown = std::min(left, 0.5f * width);
    const float right_shown = std::min(right, 0.5f * width);
    layout.left = {0.0f, bar, left_shown, middle};
    layout.right = {width - right_shown, bar, right_shown, middle};
    if (accuracy) {
        const float below = std::round((detail ? kSmallAccuracyShare : kAccuracyShare) * middle);
        layout.right.height = middle - below;
        layout.accuracy = {width - right_shown, bar + middle - below, right_shown, below};
    }
    layout.clear = {left_shown, bar, width - left_shown - right_shown, middle};
    const bool floating = layout.clear.width < kSmallestViewEm * em;
    layout.view = floating ? Rect{0.0f, bar, width, middle} : layout.clear;
    return layout;
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

ImageSize fit_image(const Rect& view, int width, int height) {
    constexpr float kMinWidth = 64.0f;
    const float shape = static_cast<float>(std::max(height, 1)) / static_cast<float>(std::max(width, 1));
    const float w = std::max(std::floor(std::min(view.width, view.height / shape)), kMinWidth);
    return {static_cast<int>(w), std::max(static_cast<int>(std::lround(w * shape)), 1)};
}

}  // namespace pl
