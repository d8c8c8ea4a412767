// Random numbers of a batch of paths for their next vertices.
#pragma once

#include <vector>

#include "core/kernel/integrator/steps.h"
#include "cpu/base/lane_kernels.h"

namespace pl {

/// The numbers are bit-identical to draw_vertex_uniforms() of each path.
class UniformBatch {
public:
    UniformBatch(std::uint32_t capacity, bool with_light)
        : counters_(group_count(capacity)), scatter_(counters_.size()), light_(with_light ? counters_.size() : 0) {}

    template <FeatureSet F, class M>
    void set_path(std::uint32_t index, const PathState<F, M>& state) {
        CounterGroup& group = counters_[index / kGroupSize];
        const std::uint32_t lane = index % kGroupSize;
        group.pixel[lane] = state.pixel;
        group.sample[lane] = state.sample;
        group.vertex[lane] = state.vertices + 1;
    }

    void move(std::uint32_t from, std::uint32_t to) {
        const CounterGroup& source = counters_[from / kGroupSize];
        CounterGroup& group = counters_[to / kGroupSize];
        group.pixel[to % kGroupSize] = source.pixel[from % kGroupSize];
        group.sample[to % kGroupSize] = source.sample[from % kGroupSize];
        group.vertex[to % kGroupSize] = source.vertex[from % kGroupSize];
    }
    std::uint32_t pixel(std::uint32_t index) const { return counters_[index / kGroupSize].pixel[index % kGroupSize]; }
    std::uint32_t sample(std::uint32_t index) const {
        return counters_[index / kGroupSize].sample[index % kGroupSize];
    }
    CounterGroup* counter_groups() { return counters_.data(); }
    const UniformGroup* scatter_groups() const { return scatter_.data(); }
    /// Null without light sampling.
    const UniformGroup* light_groups() const { return light_.empty() ? nullptr : light_.data(); }

    /// Draws the numbers of the first `count` paths.
    void draw(const PathSettings& settings, std::uint32_t count) {
        DrawKey key{settings.seed, settings.stream, Purpose::Scatter, settings.sequences};
        draw_rows(key, scatter_, count);
        key.purpose = Purpose::Light;
        if (!light_.empty()) draw_rows(key, light_, count);
    }

    VertexUniforms uniforms(std::uint32_t index) const {
        VertexUniforms uniforms{.scatter = scatter_[index / kGroupSize].get(index % kGroupSize)};
        if (!light_.empty()) uniforms.light = light_[index / kGroupSize].get(index % kGroupSize);
        return uniforms;
    }

private:
    void draw_rows(const DrawKey& key, std::vector<UniformGroup>& rows, std::uint32_t count) const {
        kernels_.draw_vertices(key, counters_.data(), rows.data(), group_count(count));
    }

    LaneKernels kernels_ = best_lane_kernels();
    std::vector<CounterGroup> counters_;
    std::vector<UniformGroup> scatter_;
    std::vector<UniformGroup> light_;  ///< empty without light sampling
};

}  // namespace pl
