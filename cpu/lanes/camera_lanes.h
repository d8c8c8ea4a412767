// Camera rays in SIMD lanes. Included by one file per instruction set; see lanes.h. Bit-identical to camera_ray().
#pragma once

#include "core/kernel/integrator/steps.h"
#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

/// Of a pinhole, whose rays start at its eye.
class CameraLanes : GroupRows {
public:
    PL_INLINE CameraLanes(const Camera& camera, const PixelGrid& grid, std::uint32_t first)
        : GroupRows(first), camera_(camera), grid_(grid) {}

    PL_INLINE void find(const CounterGroup& counters, const NumberGroup& numbers, VectorGroup& directions) const {
        std::int32_t x[kLaneWidth], y[kLaneWidth];
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) {
            const std::uint32_t pixel = counters.pixel[first() + lane];
            x[lane] = static_cast<std::int32_t>(pixel % grid_.width);
            y[lane] = static_cast<std::int32_t>(pixel / grid_.width);
        }
        const Real2<Lanes> in_pixel =
            film_point<Lanes>({row(numbers.rows[0]), row(numbers.rows[1])}, sequence_steps(grid_.sample));
        const Real2<Lanes> film{Lanes::to_real(load_lanes<LaneInt>(x)) + in_pixel.x,
                                Lanes::to_real(load_lanes<LaneInt>(y)) + in_pixel.y};
        const Vec2f resolution{static_cast<float>(grid_.width), static_cast<float>(grid_.height)};
        store(camera_direction(camera_, film, resolution), directions);
    }

private:
    const Camera& camera_;
    const PixelGrid& grid_;
};

}  // namespace
}  // namespace pl
