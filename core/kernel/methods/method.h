// What a method is: how the next direction of a path is chosen, and what is learned from where it led.
// The integrator is a template over it; there are no virtual calls and no run-time switches on the way.
#pragma once

#include <concepts>

#include "core/kernel/base/rng.h"
#include "core/kernel/scene/surface_point.h"
#include "core/kernel/shading/lambert.h"

namespace pl {

/// A sampled direction and the density it was sampled with; pdf_sa 0 means a counted zero-valued sample.
struct DirectionSample {
    Vec3f wi{0.0f};
    float pdf_sa = 0.0f;
    float bsdf_pdf_sa = 0.0f;  ///< what BSDF sampling would have given it
    std::int32_t cell = -1;    ///< of the table that the method samples from; -1: there is none, or not that way
};

/// What a path met at the end of its last segment, for learning. `V` of a guided method's vertex completes it.
struct Arrival {
    Vec3f emitted{0.0f};  ///< radiance emitted towards the previous vertex (or the environment's)
    Vec3f albedo{0.0f};   ///< reflectance of the surface met; 0 on a miss
};

/// Events a method reports; the driver adds them up.
struct MethodCounters {
    std::uint64_t records = 0;
    std::uint64_t lookups = 0;
    std::uint64_t lookup_misses = 0;
};

/// `Vertex` is what a method knows about the surface point a path stands on; `Memory` is what it keeps until the
/// next vertex is reached; `Expectation` is what it keeps of the path's start, to judge what the path is still worth.
/// `Record` is one observation on its way into the tables: learn() makes it, commit() adds it, any thread at any time
/// before the pass ends. Methods that learn nothing have empty ones, which cost no byte of path state.
///
/// roulette_worth(vertex, albedo, throughput, survival, expectation): what the path can still bring, as a share of
/// what it could at its first vertex: Russian roulette is played on it. Called once per vertex. `survival` is the product of the
/// albedos, divided by the chances of earlier roulettes.
template <class M>
concept Method = requires(const M& method, const typename M::Vertex& vertex, const typename M::Memory& memory,
                          const SurfacePoint& surface, const Rng& rng, Vec3f wi, Vec4f u, const Arrival& arrival,
                          MethodCounters& counters, typename M::Expectation& expectation) {
    { method.arrive(surface, counters) } -> std::same_as<typename M::Vertex>;
    { method.sample_direction(vertex, surface, rng, std::uint32_t{}, u) } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, wi) } -> std::same_as<float>;
    { method.remember(vertex, DirectionSample{}) } -> std::same_as<typename M::Memory>;
    { method.roulette_worth(vertex, wi, wi, float{}, expectation) } -> std::same_as<float>;
    { method.learn(memory, arrival, vertex, counters) } -> std::same_as<typename M::Record>;
    { method.commit(typename M::Record{}) } -> std::same_as<void>;
};

}  // namespace pl
