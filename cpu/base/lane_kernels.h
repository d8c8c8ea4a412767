// Loops over SIMD lanes of rays or paths, compiled once per instruction set with bit-identical results.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/kernel/guiding/vertex_network.h"
#include "cpu/base/groups.h"

namespace pl {

struct LaneKernels {
    const char* isa;
    /// Closest hits of `groups` groups of rays, tested against all triangles.
    void (*find_closest)(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups);
    void (*find_occluded)(const DenseView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t groups);
    /// Hits of the first `count` rays by the wide hierarchy.
    void (*find_closest_wide)(const WideView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count);
    void (*find_occluded_wide)(const WideView& scene, const RayGroup* rays, OcclusionMask* masks,
                               std::uint32_t count);
    /// Goes on from hits among other triangles, or from occlusion by them, with the instances of a scene.
    void (*find_closest_instances)(const WideInstances& scene, const RayGroup* rays, HitGroup* hits,
                                   std::uint32_t count);
    void (*find_occluding_instances)(const WideInstances& scene, const RayGroup* rays, OcclusionMask* masks,
                                     std::uint32_t count);
    /// Evaluates Rng::draw() for every counter.
    void (*draw)(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms, std::uint32_t groups);
    /// Evaluates vertex_uniforms() for every counter.
    void (*draw_vertices)(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms,
                          std::uint32_t groups);
    /// Directions of camera rays through the pixels of the counters, see camera_ray(), for a pinhole. `numbers`: the first ones of the
    /// pixels' sequences.
    void (*find_camera_directions)(const Camera& camera, const PixelGrid& grid, const CounterGroup* counters,
                                   const UniformGroup* uniforms, VectorGroup* directions, std::uint32_t groups);
    /// The surface points at hits, and the places of their volumes.
    void (*find_points)(const PlacementRows& scene, const RayGroup* rays, const HitGroup* hits, PointGroup* points,
                        std::uint32_t groups);
    /// Sets PointGroup::wanted of lanes that hit a surface which reflects, and PointGroup::cells.
    void (*mark_places)(const PlacementRows& scene, const HitGroup* hits, PointGroup* points, std::uint32_t groups);
    /// Reads the cells at the places of the lanes in PointGroup::cells, takes lanes out of it whose cells have no nodes, and
    /// prefetches the nodes of the others.
    void (*read_cells)(const PlacementRows& scene, PointGroup* points, std::uint32_t groups);
    /// Finds the nearest volumes of lanes in PointGroup::cells.
    void (*find_nearest)(const PlacementRows& scene, PointGroup* points, std::uint32_t groups);
    /// Samples table rows for sample_guided() and prefetches the columns it reads.
    void (*sample_rows)(const TableSampler& tables, const VertexGroup& vertices, const GuidedGroup& paths,
                        SampledGroup& sampled);
    /// Guided::sample_direction() at every vertex.
    void (*sample_guided)(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                          SampledGroup* sampled, DirectionGroup* directions, std::uint32_t groups);
    /// Guided::pdf_sa() towards every light.
    void (*weigh_guided)(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                         const LightSampleGroup* lights, DirectionGroup* directions, std::uint32_t groups);
    /// DefaultMethod::sample_direction() at every vertex.
    void (*sample_lambert)(const VertexGroup* vertices, DirectionGroup* directions, std::uint32_t groups);
    /// DefaultMethod::pdf_sa() towards every light.
    void (*weigh_lambert)(const VertexGroup* vertices, const LightSampleGroup* lights, DirectionGroup* directions,
                          std::uint32_t groups);
    /// Samples a light for every vertex, chosen by power: for scenes without a light tree.
    void (*sample_lights)(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                          std::uint32_t groups);
    /// Chooses a light for every vertex by a light tree, for sample_chosen_lights().
    void (*choose_by_tree)(const LightTreeRows& tree, const VertexGroup* vertices, const LearnedLightsGroup* learned,
                           LightSampleGroup* samples, std::uint32_t groups);
    /// The densities of light sampling at lights that were hit.
    void (*find_light_densities)(const LightTreeRows& tree, LightHitGroup* hits, std::uint32_t groups);
    void (*sample_chosen_lights)(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                                 std::uint32_t groups);
    /// Samples far lights for the vertices that choose them, and keeps the samples in `far`.
    void (*sample_far_lights)(const FarRows& lights, const VertexGroup* vertices, FarSampleGroup* far,
                              LightSampleGroup* samples, std::uint32_t groups);
    /// Weighs the light samples by multiple importance sampling, with the densities in `directions`. Clears pdf_sa of
    /// samples that cannot contribute.
    void (*weigh_lights)(const VertexGroup* vertices, const DirectionGroup* directions, LightSampleGroup* samples,
                         std::uint32_t groups);
    /// The vertices at the ends of a block's segments: surfaces, reflectances as of Lambert reflectors, and numbers of vertices. Rows of paths that hit nothing
    /// are arbitrary.
    void (*reach_vertices)(const SurfaceRows& scene, std::uint32_t max_depth, const BlockRows& block,
                           SegmentMarks& marks);
    /// Plays Russian roulette at the vertices of a block, see pl::play_roulette(), and marks the paths that go on. `estimates`: of
    /// contributions, one per path of the block; null: PathState::survival.
    void (*play_roulette)(const PathSettings& settings, const BlockRows& block, const float* estimates,
                          BlockBits& continuing);
    /// Sends paths of a block into their directions, see scatter_lambert(). `lit`: at entry these paths, at return
    /// the paths whose directions have a weight above 0. Rays and densities of the other paths are then arbitrary.
    void (*scatter_paths)(const BlockRows& block, const DirectionGroup* directions, RayGroup* rays, BlockBits& lit);
    /// Appends the shadow rays of a block's light samples to the `count` rays of a batch, whose t_max is 1, and returns the number of
    /// rays then. `lit`: comes in as the paths that have light samples, and leaves as the paths that have shadow
    /// rays, whose contributions are kept.
    std::uint32_t (*pack_shadow_rays)(const BlockRows& block, const LightSampleGroup* samples, BlockBits& lit,
                                      VectorGroup* kept, RayGroup* rays, std::uint32_t count);
    /// Adds the contributions of light samples to the paths in `lit`.
    void (*connect_paths)(const VectorGroup* lights, const BlockBits& lit, PathGroup* paths, std::uint32_t groups);
    /// The volumes of a block's vertices: what directions are sampled by, and their values. `rows`: served are the vertices that may have
    /// a volume. Returns the vertices that have a volume, and marks the vertices whose volume has no known node:
    /// their sites and normals are arbitrary.
    BlockBits (*look_up_volumes)(const VolumeRows& field, const LearningRows& rows, BlockBits& unknown);
    /// Contribution estimates at the vertices in `reached`.
    void (*estimate_contributions)(const LearningRows& rows, const BlockBits& reached, BlockFloats& estimates);
    /// Targets of the training samples that a block's segments complete. `emitted`: see TableLanes::complete(); `most`: the largest
    /// target. Marks the samples, and the clamped samples.
    void (*complete_samples)(const LearningRows& rows, bool is_indirect, float most, const BlockFloats& emitted,
                             BlockFloats& targets, BlockBits& samples, BlockBits& clamped);
    /// Opens training samples for the paths in `scattered`.
    void (*open_samples)(const LearningRows& rows, const DirectionGroup* directions, const BlockBits& scattered);
    /// Whether any cell of a volume has new training samples.
    bool (*has_samples)(const TableUpdateView& field, std::uint32_t volume);
    /// The update of one volume's table: update_volume() without the BSDF fraction and the reach. Returns false, and changes
    /// nothing, if the vectors do not fit the table's side.
    bool (*update_table)(const TableUpdateView& field, std::uint32_t volume);
    // The next three serve the update of neural fields.
    void (*multiply)(const MatrixProduct& product);
    void (*descend)(const DescentStep& step);
    /// Fills `shares`. Returns the expected logarithm of the density of all components together.
    float (*attribute)(const MixtureLight& light, MixtureShares& shares);
    VertexEvaluator evaluate_vertex;
};

extern const LaneKernels kLaneKernelsBaseline;
extern const LaneKernels kLaneKernelsAvx2;    ///< only in builds with PL_LANE_CLONES
extern const LaneKernels kLaneKernelsAvx512;  ///< only in builds with PL_LANE_CLONES

/// Kernels in this build that the machine supports, widest vectors last.
std::span<const LaneKernels> usable_lane_kernels();

inline const LaneKernels& best_lane_kernels() { return usable_lane_kernels().back(); }

/// Instruction sets that this build has kernels for, narrowest vectors first.
std::vector<std::string_view> compiled_lane_names();
/// The instruction set whose kernels run on this machine.
std::string_view used_lane_name();

}  // namespace pl
