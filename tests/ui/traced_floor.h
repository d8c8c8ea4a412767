// A pixel of the small scene whose paths are traced.
#pragma once

#include "ui/model/viewer_model.h"

namespace pl::test {
using namespace pl::ui;

/// On the floor of the small scene, in [0, 1] of the picture.
inline constexpr Vec2f kFloor{0.5f, 0.65f};

inline bool is_traced(const ViewerModel& model) {
    return model.paths().paths() != nullptr && !model.paths().is_tracing();
}

}  // namespace pl::test
