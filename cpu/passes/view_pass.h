// Views of the first surface: one camera ray per pixel, traced singly.
#pragma once

#include "core/kernel/inspect/views.h"
#include "cpu/passes/launchers.h"

namespace pl {

/// Arguments of a view kernel. `shown` is empty for views without a field.
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
