// The vertices of a block as structures of arrays, read one by one.
#pragma once

#include "cpu/base/lane_groups.h"

namespace pl {

class VertexRows {
public:
    VertexGroup* groups() { return groups_; }
    const VertexGroup* groups() const { return groups_; }
    Vec3f albedo(std::uint32_t i) const { return group(i).albedo.get(i % kGroupSize); }
    std::uint32_t primitive(std::uint32_t i) const { return group(i).primitive[i % kGroupSize]; }
    Vec4f light_numbers(std::uint32_t i) const { return group(i).light.get(i % kGroupSize); }
    /// Without the material and the side.
    SurfacePoint surface(std::uint32_t i) const {
        const VertexGroup& from = group(i);
        const std::uint32_t lane = i % kGroupSize;
        return {.position = from.position.get(lane),
                .geometric_normal = from.geometric_normal.get(lane),
                .shading_normal = from.shading_normal.get(lane),
                .position_error = from.position_error[lane],
                .primitive = from.primitive[lane]};
    }

private:
    const VertexGroup& group(std::uint32_t i) const { return groups_[i / kGroupSize]; }

    VertexGroup groups_[kBlockGroups];
};

}  // namespace pl
