// Traversal of the wide hierarchy by one ray, whose tests of a node's children are in lanes, or by several in turn.
// Included by one file per instruction set; see lanes.h.
#pragma once

#include <cstddef>
#include <type_traits>

#include "cpu/lanes/leaf_lanes.h"
#include "cpu/lanes/node_walk.h"

namespace pl {
namespace {

/// One ray's way through the hierarchy.
template <bool kAny>
class WideTraversal {
public:
    /// Starts at the root; `lane` is the ray's in its groups. `stack` has room for kWideStack children.
    PL_INLINE void start(const RayGroup& rays, const PreparedGroup& group, std::uint32_t lane, EnteredChild* stack) {
        ray_ = {&group, lane};
        excluded_ = {rays.source[lane], rays.target[lane]};
        best_.t = rays.t_max[lane];
        best_.primitive = kNoPrimitive;
        best_.b1 = best_.b2 = 0.0f;
        walk_.start(0, stack);
        if (((group.can_hit >> lane) & 1u) == 0) walk_.stop();
    }

    PL_INLINE bool is_over() const { return walk_.is_over(); }
    PL_INLINE bool is_at_leaf() const { return walk_.is_at_leaf(); }
    PL_INLINE const Hit& best() const { return best_; }

    PL_INLINE void descend(const WideView& scene) { walk_.descend(scene.nodes, ray_, best_.t); }
    /// `leaves`: the scene's triangles or blocks.
    template <class Stored>
    PL_INLINE void test_leaf(const Stored* leaves) {
        const LeafTest<kAny> test(*ray_.group, ray_.lane);
        if (test.find(leaves, walk_.at(), excluded_, best_))
            walk_.stop();
        else
            walk_.leave(best_.t);
    }

    /// Asks for the memory that the next step reads.
    PL_INLINE void prefetch(const WideView& scene) const {
        if (is_over()) return;
        const WideReference next = walk_.at();
        const bool is_leaf = next.count() > 0;
        const char* memory = is_leaf ? reinterpret_cast<const char*>(scene.triangles + next.first())
                                     : reinterpret_cast<const char*>(scene.nodes + next.first());
        const std::size_t bytes = is_leaf ? next.count() * sizeof(BvhTriangle) : sizeof(WideNode);
        constexpr std::size_t kLine = 64;
        for (std::size_t at = 0; at < bytes; at += kLine) __builtin_prefetch(memory + at);
    }

private:
    GroupRay ray_;
    ExcludedPair excluded_;
    Hit best_;
    NodeWalk walk_;
};

/// Traces rays one after the other: the fastest way as long as the hierarchy stays in the caches, because branches are
/// predicted best. `finish(index, hit)` takes the results.
template <bool kAny, class Finish>
PL_INLINE void trace_one_by_one(const WideView& scene, const RayGroup* rays, std::uint32_t count, Finish&& finish) {
    EnteredChild stack[kWideStack];
    PreparedGroup prepared;
    for (std::uint32_t first = 0; first < count; first += kGroupSize) {
        const RayGroup& group = rays[first / kGroupSize];
        prepare(scene.root, group, prepared);
        const std::uint32_t end = min_of(kGroupSize, count - first);
        for (std::uint32_t lane = 0; lane < end; ++lane) {
            WideTraversal<kAny> way;
            way.start(group, prepared, lane, stack);
            while (!way.is_over()) {
                if (way.is_at_leaf())
                    way.test_leaf(scene.blocks);
                else
                    way.descend(scene);
            }
            finish(first + lane, way.best());
        }
    }
}

/// Traces several rays in turn, so that the memory of one arrives while the others are tested. In every round the
/// rays at inner nodes go one step, then the rays at leaves.
template <bool kAny, class Finish>
class RaysInFlight {
public:
    PL_INLINE RaysInFlight(const WideView& scene, Finish& finish) : scene_(scene), finish_(finish) {}

    PL_INLINE void trace(const RayGroup* rays, std::uint32_t first, std::uint32_t end) {
        rays_ = rays;
        first_ = next_ = first;
        end_ = end;
        for (std::uint32_t group = first; group < end; group += kGroupSize)
            prepare(scene_.root, rays[group / kGroupSize], prepared_[(group - first) / kGroupSize]);
        for (std::uint32_t slot = 0; slot < kSlots && next_ < end_; ++slot) start(slot);
        while (nodes_.count + leaves_.count + over_.count > 0) {
            for_each(nodes_, [&](std::uint32_t slot) {
                ways_[slot].descend(scene_);
                go_on(slot);
            });
            for_each(leaves_, [&](std::uint32_t slot) {
                ways_[slot].test_leaf(scene_.triangles);
                go_on(slot);
            });
            for_each(over_, [&](std::uint32_t slot) {
                finish_(index_[slot], ways_[slot].best());
                if (next_ < end_) start(slot);
            });
        }
    }

    /// Most rays of a call of trace(): as many as there is memory for prepared rays.
    static constexpr std::uint32_t kMostRays = 16 * kGroupSize;

private:
    static constexpr std::uint32_t kSlots = 16;

    struct Slots {
        std::uint32_t entries[kSlots];
        std::uint32_t count = 0;
    };

    template <class Step>
    PL_INLINE void for_each(Slots& slots, Step&& step) {
        const std::uint32_t count = slots.count;
        slots.count = 0;
        for (std::uint32_t i = 0; i < count; ++i) step(slots.entries[i]);
    }
    PL_INLINE void start(std::uint32_t slot) {
        const std::uint32_t place = next_ - first_;
        ways_[slot].start(rays_[next_ / kGroupSize], prepared_[place / kGroupSize], place % kGroupSize,
                          stacks_[slot]);
        index_[slot] = next_++;
        go_on(slot);
    }
    PL_INLINE void go_on(std::uint32_t slot) {
        const WideTraversal<kAny>& way = ways_[slot];
        way.prefetch(scene_);
        Slots& slots = way.is_over() ? over_ : way.is_at_leaf() ? leaves_ : nodes_;
        slots.entries[slots.count++] = slot;
    }

    const WideView& scene_;
    Finish& finish_;
    const RayGroup* rays_;
    std::uint32_t first_, next_, end_;
    Slots nodes_, leaves_, over_;
    std::uint32_t index_[kSlots];
    WideTraversal<kAny> ways_[kSlots];
    PreparedGroup prepared_[kMostRays / kGroupSize];
    EnteredChild stacks_[kSlots][kWideStack];
};

template <bool kAny, class Finish>
PL_INLINE void trace_all(const WideView& scene, const RayGroup* rays, std::uint32_t count, Finish&& finish) {
    if (scene.blocks != nullptr) return trace_one_by_one<kAny>(scene, rays, count, finish);
    using Flight = RaysInFlight<kAny, std::remove_reference_t<Finish>>;
    Flight flight(scene, finish);
    for (std::uint32_t first = 0; first < count; first += Flight::kMostRays)
        flight.trace(rays, first, min_of(count, first + Flight::kMostRays));
}

void find_closest_wide(const WideView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count) {
    trace_all<false>(scene, rays, count, [hits](std::uint32_t index, const Hit& hit) {
        store_hit(hit, hits[index / kGroupSize], index % kGroupSize);
    });
}

void find_occluded_wide(const WideView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t count) {
    for (std::uint32_t group = 0; group < group_count(count); ++group) masks[group] = 0;
    trace_all<true>(scene, rays, count, [masks](std::uint32_t index, const Hit& hit) {
        const std::uint32_t bit = hit.primitive != kNoPrimitive ? 1u << (index % kGroupSize) : 0u;
        OcclusionMask& mask = masks[index / kGroupSize];
        mask = static_cast<OcclusionMask>(mask | bit);
    });
}

}  // namespace
}  // namespace pl
