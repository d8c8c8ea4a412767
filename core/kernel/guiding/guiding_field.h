// A guiding field: a representation of incident radiance over all surfaces from which directions are sampled. Tables of cells
// are the first model (table_field.h); trees, lobes and networks are further models. Kernels are templates over the model.
#pragma once

#include <concepts>
#include <type_traits>

#include "core/kernel/guiding/direction_sample.h"
#include "core/kernel/shading/light_tree.h"

namespace pl {

/// A training sample whose target is unknown until the next vertex; the path keeps it from scattering to there.
template <class Field>
struct OpenSample {
    typename Field::Entry entry{};
    float bsdf_ratio = 1.0f;  ///< p_bsdf / q of the direction, q the density it was sampled with
    float distance = 0.0f;    ///< along the direction to the surface hit, scene units; 0 before the segment is traced
};

/// One observation of incident radiance, to be added to a field's pending sums.
template <class Field>
struct TrainingSample : OpenSample<Field> {
    float target = 0.0f;  ///< incident radiance, rms() of its channels
};

/// A light sample at a surface point, for the field's irradiance by light samples.
template <class Field>
struct LightSample {
    typename Field::Location location{};
    float irradiance = 0.0f;  ///< rms() of irradiance / pi with the sample's MIS weight; 0 if the light is occluded
    std::uint32_t cluster = kNoCluster;  ///< of the light, see LightTree
};

/// The operations of a field that kernels call while paths are traced. All but record(), add() and
/// record_light() are constant between two updates; these may be called by any thread in any order and have to give the same sums.
///   Location                   the part of the field that serves a surface point (a volume); default: none, is_served() false
///   Entry                      the part of the field that a direction trains (a cell); default: none, is_trained() false
///   locate(surface)            the location of a surface point
///   sample(l, surface, n)      a direction; uses n.u.y, n.u.z and further draws of n.rng. Served locations only, as below
///   density(l, surface, wi)    of sample(), per steradian at the surface point
///   bsdf_fraction_at(l)        learned fraction a of BSDF samples in the mixture, in (0, 1]
///   value_at(l)                expected irradiance / pi: the value function V of reinforcement learning
///   direct_at(l)               the same by light samples alone, with their MIS weights; 0 before the first one
///   lights_at(l)               learned choice among the clusters of the scene's light tree; empty: nothing is learned
///   entry_of(l, direction)     the entry that a sampled direction trains
///   record(sample, fraction)   adds a training sample to the pending sums; `fraction`: also to the sums of the BSDF fraction
///   add(sample, fraction)      adds radiance to the target of a training sample that was recorded before
///   record_light(light)        adds a light sample
///   is_clamped(target)         whether the sums will hold less than this target
template <class Field>
concept GuidingField = std::is_trivially_copyable_v<Field> && std::default_initializable<typename Field::Location> &&
    std::default_initializable<typename Field::Entry> &&
    requires(const Field& field, const typename Field::Location& location, const typename Field::Entry& entry,
             const SurfacePoint& surface, const ScatterUniforms& uniforms, const DirectionSample& direction,
             const TrainingSample<Field>& sample, const LightSample<Field>& light) {
    { field.locate(surface) } -> std::same_as<typename Field::Location>;
    { location.is_served() } -> std::same_as<bool>;
    { field.sample(location, surface, uniforms) } -> std::same_as<Vec3f>;
    { field.density(location, surface, Vec3f{}) } -> std::same_as<FieldDensity>;
    { field.bsdf_fraction_at(location) } -> std::same_as<float>;
    { field.value_at(location) } -> std::same_as<float>;
    { field.direct_at(location) } -> std::same_as<float>;
    { field.entry_of(location, direction) } -> std::same_as<typename Field::Entry>;
    { entry.is_trained() } -> std::same_as<bool>;
    field.record(sample, bool{});
    field.add(sample, bool{});
    { field.lights_at(location) } -> std::same_as<LearnedLights>;
    field.record_light(light);
    { field.is_clamped(float{}) } -> std::same_as<bool>;
};

/// A field that also returns its radiance in single directions, for the targets of Sarsa.
template <class Field>
concept RadianceField = GuidingField<Field> &&
    requires(const Field& field, const typename Field::Location& location) {
    /// Incident radiance in the direction of DirectionSample::bin; value_at() before the first training
    /// sample of that direction.
    { field.radiance_at(location, std::int32_t{}) } -> std::same_as<float>;
};

}  // namespace pl
