// What a method is: how the next direction of a path is chosen, and what is learned from where it led.
// The integrator is a template over it; there are no virtual calls and no run-time switches on the way.
#pragma once

#include <concepts>

#include "core/kernel/base/rng.h"
#include "core/kernel/scene/surface_point.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// A sampled direction and the density it was sampled with; pdf_sa 0 means a counted zero-valued sample.
struct DirectionSample {
    Vec3f wi{0.0f};
    float pdf_sa = 0.0f;
    float bsdf_pdf_sa = 0.0f;  ///< what BSDF sampling would have given it
    std::int32_t cell = -1;    ///< of the table that the method samples from; -1: there is none, or not that way
};

/// A direction as BSDF sampling alone weighs it.
PL_HD inline DirectionSample weigh_lambert(const SurfacePoint& surface, Vec3f wi) {
    const float pdf_sa = lambert_pdf_sa(surface, wi);
    return {wi, pdf_sa, pdf_sa};
}

/// A direction by BSDF sampling alone; u.y, u.z and `choice` are used up.
PL_HD inline DirectionSample sample_bsdf(const SurfacePoint& surface, const LayeredBsdf& bsdf, Vec4f u,
                                         float choice) {
    const Vec3f wi = bsdf.sample(surface, {u.y, u.z}, choice);
    const float pdf_sa = bsdf.pdf_sa(surface, wi);
    return {wi, pdf_sa, pdf_sa};
}

/// What a path met at the end of its last segment, for learning. `V` of a guided method's vertex completes it.
struct Arrival {
    Vec3f emitted{0.0f};  ///< radiance emitted towards the previous vertex (or the environment's)
    Vec3f albedo{0.0f};   ///< reflectance of the surface met; 0 on a miss
    /// Share of the emission that the path's direction brings; light samples at the previous vertex bring the rest.
    float light_share = 1.0f;
    float distance = kInfinity;  ///< from the previous vertex
};

/// How a path went on from a vertex.
struct Scattering {
    Vec3f weight{0.0f};  ///< BSDF x cosine / pdf, and roulette's
    Vec3f albedo{0.0f};  ///< of the surface
    DirectionSample direction;
};

/// Events a method reports; the driver adds them up.
struct MethodCounters {
    std::uint64_t records = 0;
    std::uint64_t clamped_records = 0;  ///< those that were too bright for the sums
    std::uint64_t lookups = 0;
    std::uint64_t lookup_misses = 0;
    std::uint64_t cut_returns = 0;  ///< paths that were too long to be remembered to their end
};

/// `Vertex` is what a method knows about the surface point a path stands on; `Memory` is what it keeps until the
/// next vertex is reached; `Expectation` is what it keeps of the path's start, to judge what the path is still worth.
/// `Record` is one observation on its way into the tables: learn() makes it, commit() adds it, any thread at any time
/// before the pass ends. Methods that learn nothing have empty ones, which cost no byte of path state.
///
/// sample_direction() and pdf_sa() are for Lambert reflectors, and, with a LayeredBsdf, for lobes of any other surface; the
/// latter get a further number that chooses between its lobes.
///
/// roulette_worth(vertex, albedo, throughput, survival, expectation): what the path can still bring, as a share of
/// what it could at its first vertex: Russian roulette is played on it. Called once per vertex. `survival` is the product of the
/// albedos, divided by the chances of earlier roulettes. `kSplitsPaths`: whether the opinion is good enough to go on in several
/// directions where the path is worth much.
template <class M>
concept Method = requires(const M& method, const typename M::Vertex& vertex, typename M::Memory& memory,
                          const SurfacePoint& surface, const Rng& rng, Vec3f wi, Vec4f u, const Arrival& arrival,
                          MethodCounters& counters, typename M::Expectation& expectation, const LayeredBsdf& bsdf) {
    { method.arrive(surface, counters) } -> std::same_as<typename M::Vertex>;
    { method.sample_direction(vertex, surface, rng, std::uint32_t{}, u) } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, wi) } -> std::same_as<float>;
    {
        method.sample_direction(vertex, surface, bsdf, rng, std::uint32_t{}, u, float{})
        } -> std::same_as<DirectionSample>;
    { method.pdf_sa(vertex, surface, bsdf, wi) } -> std::same_as<float>;
    { method.remember(vertex, DirectionSample{}) } -> std::same_as<typename M::Memory>;
    { method.roulette_worth(vertex, wi, wi, float{}, expectation) } -> std::same_as<float>;
    { M::kSplitsPaths } -> std::convertible_to<bool>;
    { method.learn(memory, arrival, vertex, counters) } -> std::same_as<typename M::Record>;
    { method.commit(typename M::Record{}) } -> std::same_as<void>;
};

/// Methods that learn from more than where the last direction led. Their Memory follows the path; instead of remember(),
/// the integrator calls depart() where a vertex is left, and stop() where a path ends at one by chance. request_light() gets
/// what the surface would reflect of the light sample there, receive_light() follows if nothing is in between, also after
/// depart(). finish() comes last, once for each branch of a path. Memory holds the weight of the roulette that the path survived last, which
/// the integrator sets.
template <class M>
concept FollowingMethod = Method<M> &&
    requires(const M& method, typename M::Memory& memory, const typename M::Vertex& vertex, Vec3f reflected,
             const Scattering& scattering, MethodCounters& counters) {
    method.request_light(memory, reflected);
    method.receive_light(memory, counters);
    method.depart(memory, vertex, scattering, counters);
    { memory.roulette_weight } -> std::same_as<float&>;
    method.stop(memory, counters);
    method.finish(memory, counters);
};

/// Methods whose paths have branches: each begins with an empty Memory.
template <class M>
concept SplittingMethod = Method<M> && M::kSplitsPaths;

}  // namespace pl
