// Views of the first surface: one camera ray per pixel, one pixel after the other.
#pragma once

#include "core/kernel/inspect/views.h"
#include "cpu/launchers.h"

namespace pl {

/// What a kernel that shows a view is called with. `shown` may be empty where the view does not need it.
struct ViewPass {
    PassSetup setup;
    View view = View::Normal;
    ShownField shown;
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
};

extern const PassKernels<ViewPass> kViewKernels;

}  // namespace pl
