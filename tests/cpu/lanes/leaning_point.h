// A vertex at a Lambert reflector as of any mesh, for tests of lanes.
#pragma once

#include "core/kernel/integrator/scatter.h"
#include "core/kernel/methods/default.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

using LeaningPoint = ScatterPoint<FeatureSet{}, DefaultMethod>;

/// A surface point whose shading normal often leans far from the geometric one, so that some directions are black.
inline LeaningPoint random_point(Uniforms& random) {
    LeaningPoint point;
    point.surface.position = random.between(0.0f, 3.0f) * random.direction();
    point.surface.geometric_normal = random.direction();
    point.surface.shading_normal = random.below(2) == 0 ? point.surface.geometric_normal : random.direction();
    point.surface.position_error = random.between(0.0f, 1e-3f);
    point.surface.primitive = random.below(100);
    point.bsdf = {random.cube(0.0f, 1.0f)};
    return point;
}

}  // namespace pl::test
