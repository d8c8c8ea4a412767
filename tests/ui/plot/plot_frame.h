// Where tests draw their plots.
#pragma once

#include "ui/draw/draw_list.h"

namespace pl::test {

inline constexpr ui::Rect kPlotFrame{100.0f, 50.0f, 300.0f, 200.0f};

}  // namespace pl::test
