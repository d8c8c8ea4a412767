// The colors of the window as a choice.
#pragma once

namespace pl::ui {

enum class Theme { Dark, Light };

}  // namespace pl::ui
