// Importance sampling from a radiance map that was computed before rendering and is then frozen.
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

struct PrecomputedMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;
    struct Memory {};
    struct Record {};

    PL_HD Memory remember(const Vertex&, const DirectionSample&) const { return {}; }
    PL_HD Record learn(const Memory&, const Arrival&, const Vertex&, MethodCounters&) const { return {}; }
    PL_HD void commit(const Record&) const {}
};
static_assert(Method<PrecomputedMethod>);

}  // namespace pl
