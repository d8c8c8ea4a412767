// Importance sampling from a radiance map that was computed before rendering and is then frozen.
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

struct PrecomputedMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;
    struct Memory {};

    PL_HD Memory remember(const Vertex&, const DirectionSample&) const { return {}; }
    PL_HD void learn(Memory&, const Arrival&, const Vertex&, MethodCounters&) const {}
};
static_assert(Method<PrecomputedMethod>);

}  // namespace pl
