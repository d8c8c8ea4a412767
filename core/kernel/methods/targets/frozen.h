// No target: the field stays constant while paths are traced.
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

template <GuidingField F>
struct FrozenField : FieldTrainer<F> {};

}  // namespace pl
