// The colors of the window as a choice.
#pragma once

namespace pl::ui {

enum class Theme { Dark, Light, HighContrast };
inline constexpr int kThemeCount = 3;

}  // namespace pl::ui
