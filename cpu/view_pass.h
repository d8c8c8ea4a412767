// Views of the first surface: one camera ray per pixel, one pixel after the other.
#pragma once

#include "core/kernel/inspect/views.h"
#include "cpu/launchers.h"

namespace pl {

/// Arguments of a view kernel. `shown` is empty for views that need no field.
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
