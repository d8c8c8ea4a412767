#include "core/session/backend.h"

namespace pl {

PassCounters& PassCounters::operator+=(const PassCounters& other) {
    path.segments += other.path.segments;
    path.shadow_rays += other.path.shadow_rays;
    path.escaped += other.path.escaped;
    path.truncated += other.path.truncated;
    path.zero_directions += other.path.zero_directions;
    path.method.records += other.path.method.records;
    path.method.lookups += other.path.method.lookups;
    path.method.lookup_misses += other.path.method.lookup_misses;
    paths += other.paths;
    zero_contribution_paths += other.zero_contribution_paths;
    invalid_samples += other.invalid_samples;
    return *this;
}

}  // namespace pl
