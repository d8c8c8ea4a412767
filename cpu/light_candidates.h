// Light samples of a block of paths, taken in SIMD lanes where lights are few.
#pragma once

#include <vector>

#include "core/kernel/integrator/steps.h"
#include "cpu/lane_kernels.h"
#include "cpu/lookups_ahead.h"

namespace pl {

/// The lights of a scene by columns; empty if they are chosen by a tree.
class LightTable {
public:
    explicit LightTable(const SceneView& scene) : count_(scene.light_tree.empty() ? scene.lights.count : 0) {
        numbers_.resize(std::size_t{LightColumns::kCount} * count_);
        for (std::uint32_t light = 0; light < count_; ++light) fill(scene, light);
    }
    bool empty() const { return count_ == 0; }
    LightColumns columns() const { return {numbers_.data(), count_}; }

private:
    void fill(const SceneView& scene, std::uint32_t light) {
        const std::uint32_t primitive = scene.lights[light].primitive;
        const Triangle& triangle = scene.triangles[primitive];
        const TrianglePlane& plane = scene.planes[primitive];
        set(LightColumns::kCorner0, light, scene.positions[triangle.v0]);
        set(LightColumns::kCorner1, light, scene.positions[triangle.v1]);
        set(LightColumns::kCorner2, light, scene.positions[triangle.v2]);
        set(LightColumns::kNormal, light, plane.normal);
        set(LightColumns::kPositionError, light, plane.position_error);
        set(LightColumns::kPdfArea, light, light_pdf_area(scene, scene.materials[triangle.material]));
        set(LightColumns::kCumulative, light, scene.lights[light].cumulative_probability);
    }
    void set(int column, std::uint32_t light, float number) {
        numbers_[static_cast<std::size_t>(column) * count_ + light] = number;
    }
    void set(int column, std::uint32_t light, Vec3f v) {
        for (int axis = 0; axis < 3; ++axis) set(column + axis, light, v[axis]);
    }

    std::uint32_t count_;
    std::vector<float> numbers_;
};

/// At most kGuidedBlock vertices at Lambert reflectors, whose lights are sampled at once: bit-identical to sample_light().
template <FeatureSet F, Method M>
class LightCandidates : public BlockPaths {
public:
    explicit LightCandidates(const PathContext<M>& context, const LaneKernels& kernels = best_lane_kernels())
        : context_(context), table_(context.scene), kernels_(kernels) {}

    /// Whether lanes can sample a light by these numbers.
    bool takes(const ScatterPoint<F, M>& from, [[maybe_unused]] Vec4f u) const {
        if (table_.empty()) return false;
        if constexpr (F.has(Feature::EnvironmentMap)) {
            if (u.w < context_.scene.far_probability) return false;
        }
        return from.bsdf.is_lambert();
    }
    void add(std::uint32_t path, const ScatterPoint<F, M>& from, Vec4f u, const ReceivedWeights& weights) {
        const std::uint32_t i = count();
        ReceiverGroup& group = receivers_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        group.position.set(lane, from.surface.position);
        group.geometric_normal.set(lane, from.surface.geometric_normal);
        group.shading_normal.set(lane, from.surface.shading_normal);
        group.position_error[lane] = from.surface.position_error;
        for (int number = 0; number < 3; ++number) group.u[number][lane] = u[number];
        points_[i] = from;
        numbers_[i] = u;
        weights_[i] = weights;
        append(path);
    }
    void sample() { kernels_.sample_lights(table_.columns(), receivers_, samples_, group_count(count())); }

    const ScatterPoint<F, M>& point(std::uint32_t i) const { return points_[i]; }
    bool is_near(std::uint32_t i) const { return samples_[i / kGroupSize].is_near[i % kGroupSize] != 0; }
    UnweightedLight light(std::uint32_t i) const {
        const LightSampleGroup& group = samples_[i / kGroupSize];
        const std::uint32_t lane = i % kGroupSize;
        const ScatterPoint<F, M>& from = points_[i];
        if (is_near(i)) return sample_light(context_, from, numbers_[i], weights_[i]);
        const std::uint32_t primitive =
            context_.scene.lights[static_cast<std::uint32_t>(group.light[lane])].primitive;
        if (!(group.pdf_sa[lane] > 0.0f) || primitive == from.surface.primitive) return {};
        DirectLight sample;
        sample.light.primitive = primitive;
        sample.light.material = context_.scene.triangles[primitive].material;
        sample.light.front = group.is_behind[lane] == 0;
        sample.wi = group.wi.get(lane);
        sample.cos_i = group.cos_i[lane];
        sample.pdf_sa = group.pdf_sa[lane];
        sample.emitted = light_emitted<F>(context_.scene, sample.light, group.weights.get(lane));
        if (is_black(sample.emitted)) return {};
        return reflect_light(from, sample,
                             {.origin = group.origin.get(lane),
                              .direction = group.direction.get(lane),
                              .t_max = 1.0f,
                              .source = from.surface.primitive,
                              .target = primitive},
                             weights_[i]);
    }

private:
    const PathContext<M>& context_;
    LightTable table_;
    LaneKernels kernels_;
    ScatterPoint<F, M> points_[kGuidedBlock];
    Vec4f numbers_[kGuidedBlock];
    ReceivedWeights weights_[kGuidedBlock];
    ReceiverGroup receivers_[kGuidedGroups];
    LightSampleGroup samples_[kGuidedGroups];
};
template <FeatureSet F, Method M>
requires(!F.has(Feature::NextEventEstimation)) class LightCandidates<F, M> {
public:
    explicit LightCandidates(const PathContext<M>&) {}
};

}  // namespace pl
