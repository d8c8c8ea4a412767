// No target: the field stays constant while paths are traced.
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

template <GuidingField F>
struct FrozenField : FieldTrainer<F> {
    static constexpr bool kLearnsLights = true;  ///< the field may have learned them before
    static constexpr bool kIsConstant = true;
};

}  // namespace pl
