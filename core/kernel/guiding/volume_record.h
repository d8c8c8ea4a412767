// The values of a volume, besides its table, that guided paths read, gathered from the arrays of placement and tables.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// One aligned record instead of a load from each of seven arrays, by which a device reads 16 bytes at once. It repeats the arrays
/// and is gathered anew whenever they change.
struct alignas(64) VolumeRecord {
    Vec3f position;
    float inverse_reach;
    Vec3f normal;
    float bsdf_fraction;
    float mean_radiance;
    float direct;
};
static_assert(sizeof(VolumeRecord) == 64);

}  // namespace pl
