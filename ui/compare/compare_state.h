// The mode of a comparison and the choice of its two sides: settings of the window, not of the rendering.
#pragma once

#include <array>
#include <cstdint>

namespace pl::ui {

enum class CompareMode { Off, Split, Flip, SideBySide, Difference, ErrorMap };
inline constexpr int kCompareModeCount = 6;

constexpr const char* name_of(CompareMode mode) {
    constexpr std::array<const char*, kCompareModeCount> kNames{"off",          "split",      "flip",
                                                                "side by side", "difference", "error map"};
    return kNames[static_cast<std::size_t>(mode)];
}

constexpr CompareMode stepped(CompareMode mode, int steps) {
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
