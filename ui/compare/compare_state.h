// The mode of a comparison and the choice of its two sides: settings of the window, not of the rendering.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/choice.h"

namespace pl {
namespace ui {
enum class CompareMode { Off, Split, Flip, SideBySide, Difference, ErrorMap };
}

template <>
inline constexpr auto kChoices<ui::CompareMode> = std::to_array<ChoiceInfo<ui::CompareMode>>({
    {ui::CompareMode::Off, "off", "off"},
    {ui::CompareMode::Split, "split", "split"},
    {ui::CompareMode::Flip, "flip", "flip"},
    {ui::CompareMode::SideBySide, "side by side", "side by side"},
    {ui::CompareMode::Difference, "difference", "difference"},
    {ui::CompareMode::ErrorMap, "error map", "error map"},
});

}  // namespace pl

namespace pl::ui {

constexpr CompareMode stepped(CompareMode mode, int steps) {
    constexpr int kCompareModeCount = static_cast<int>(kChoices<CompareMode>.size());
    const int index = (static_cast<int>(mode) + steps % kCompareModeCount + kCompareModeCount) % kCompareModeCount;
    return static_cast<CompareMode>(index);
}

/// The choice of a side: automatic, a run by its number, or the reference.
struct SideChoice {
    enum class What { Automatic, Run, Reference };
    What what = What::Automatic;
    std::uint64_t run = 0;

    friend bool operator==(const SideChoice&, const SideChoice&) = default;
};

struct CompareState {
    CompareMode mode = CompareMode::Off;
    SideChoice a;
    SideChoice b;
    float split = 0.5f;         ///< position of the line, as a share of the picture's width
    bool shows_second = false;  ///< of CompareMode::Flip
};

}  // namespace pl::ui
