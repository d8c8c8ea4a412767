// Closest hits outside holes for batches of rays: rays that hit a hole are continued in a second batch.
#pragma once

#include <vector>

#include "core/kernel/integrator/holes.h"
#include "cpu/base/ray_batch.h"

namespace pl {

/// Hits are bit-identical to closest_solid_hit() of each ray. Allocates memory only if the scene has holes. Its functions stay apart from
/// the kernels: they are the same for all methods, and called once for a batch.
template <FeatureSet F, BatchIntersector I>
class SolidHits {
public:
    SolidHits(const SceneView& scene, const I& intersector, std::uint32_t capacity)
        : scene_(scene), intersector_(intersector), rest_(wanted(scene) ? capacity : 0),
          waiting_(wanted(scene) ? capacity : 0) {}

    [[gnu::noinline]] void find_closest(RayBatch& batch, std::uint32_t count) {
        intersector_.find_closest(batch, count);
        if constexpr (F.has(Feature::CutOuts)) {
            if (wanted(scene_)) pass_holes(batch, count);
        }
    }
    /// Marks the rays that a surface outside of holes occludes.
    [[gnu::noinline]] void find_occluded(RayBatch& batch, std::uint32_t count) {
        if (!wanted(scene_)) return intersector_.find_occluded(batch, count);
        find_closest(batch, count);
        for (std::uint32_t i = 0; i < count; ++i) batch.set_occluded(i, batch.hit(i).found());
    }

private:
    /// Whether the scene has holes.
    static bool wanted(const SceneView& scene) { return F.has(Feature::CutOuts) && !scene.opacities.empty(); }

    struct Waiting {
        std::uint32_t index;
        float passed;
    };

    [[gnu::noinline]] void pass_holes(RayBatch& batch, std::uint32_t count) {
        std::uint32_t waiting = 0;
        for (std::uint32_t i = 0; i < count; ++i)
            if (meets_hole<F>(scene_, batch.ray(i), batch.hit(i)))
                send_on(waiting++, batch.ray(i), batch.hit(i), {i, 0.0f});
        for (int holes = 1; waiting > 0; ++holes) {
            intersector_.find_closest(rest_, waiting);
            const std::uint32_t asked = waiting;
            waiting = 0;
            for (std::uint32_t i = 0; i < asked; ++i) {
                const Waiting from = waiting_[i];
                Hit hit = rest_.hit(i);
                if (holes < kMostHoles && meets_hole<F>(scene_, rest_.ray(i), hit)) {
                    send_on(waiting++, rest_.ray(i), hit, from);
                } else {
                    if (from.passed > 0.0f) hit.t += from.passed;
                    batch.set_hit(from.index, hit);
                }
            }
        }
    }

    /// Stores the remainder of a ray behind the hole in slot `place`, whose previous ray has been read.
    void send_on(std::uint32_t place, const Ray& ray, const Hit& hit, Waiting from) {
        rest_.set_ray(place, ray_behind<F>(scene_, ray, hit));
        waiting_[place] = {from.index, from.passed + hit.t};
    }

    const SceneView& scene_;
    const I& intersector_;
    RayBatch rest_;
    std::vector<Waiting> waiting_;
};

}  // namespace pl
