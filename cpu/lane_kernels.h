// Loops over SIMD lanes of rays or paths, compiled once per instruction set with bit-identical results.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/kernel/base/math.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/shading/lights.h"
#include "cpu/ray_batch.h"
#include "cpu/wide_hierarchy.h"

namespace pl {

inline constexpr std::uint32_t kMaxDenseTriangles = 64;
inline constexpr std::uint32_t kMaxDensePositions = 3 * kMaxDenseTriangles;

struct DenseTriangle {
    std::uint32_t a, b, c;    ///< indices into DenseView::positions
    std::uint32_t primitive;  ///< index of the triangle in the scene
};

/// A small scene as plain pointers: files compiled for one instruction set must not instantiate inline functions of
/// containers, which the linker would merge with those of other files.
struct DenseView {
    const Vec3f* positions;  ///< without duplicates
    std::uint32_t position_count;
    const DenseTriangle* triangles;  ///< in ascending order of primitive
    std::uint32_t triangle_count;
};

/// A scene and its wide hierarchy as plain pointers.
struct WideView {
    BvhNode root;           ///< the bounds of the scene
    const WideNode* nodes;  ///< at least one
    const BvhTriangle* triangles;
    std::uint32_t exceeds_caches;  ///< 1: memory is waited for
};

/// The arguments of Rng::draw that a batch has in common.
struct DrawKey {
    std::uint64_t seed = 0;
    Stream stream = Stream::Picture;
    Purpose purpose = Purpose::Scatter;
};

/// The remaining arguments of Rng::draw, per lane.
struct alignas(64) CounterGroup {
    std::uint32_t pixel[kGroupSize] = {}, sample[kGroupSize] = {}, vertex[kGroupSize] = {};
};

/// Four uniform numbers in [0, 1) per lane.
struct alignas(64) NumberGroup {
    float rows[4][kGroupSize] = {};

    Vec4f get(std::uint32_t lane) const { return {rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]}; }
};

/// 16 vectors as a structure of arrays.
struct alignas(64) VectorGroup {
    float x[kGroupSize] = {}, y[kGroupSize] = {}, z[kGroupSize] = {};

    void set(std::uint32_t lane, Vec3f v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    Vec3f get(std::uint32_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// 16 paths at vertices of a guided method. Lanes that were never set have no volume.
struct alignas(64) GuidedGroup {
    std::int32_t volume[kGroupSize];
    VectorGroup site, volume_normal;
    float inverse_reach[kGroupSize] = {}, bsdf_fraction[kGroupSize] = {};
    VectorGroup position, shading_normal;
    float choice[kGroupSize] = {}, u_x[kGroupSize] = {}, u_y[kGroupSize] = {};  ///< x, y, z of ScatterNumbers::u

    GuidedGroup() { std::fill_n(volume, kGroupSize, kNoVolume); }

    void set_volume(std::uint32_t lane, const ServedPoint<One>& point, float fraction) {
        volume[lane] = point.volume;
        site.set(lane, pack(point.site));
        volume_normal.set(lane, pack(point.normal));
        inverse_reach[lane] = point.inverse_reach;
        bsdf_fraction[lane] = fraction;
    }
};

/// Intermediate results of a GuidedGroup, before the evaluation of pdfs.
struct alignas(64) SampledGroup {
    std::int32_t row[kGroupSize];  ///< of the table, per lane
    VectorGroup direction;
    float square_x[kGroupSize], square_y[kGroupSize], cosine[kGroupSize], jacobian[kGroupSize];  ///< TableDirection
};

/// Sampled directions of a GuidedGroup; members as in DirectionSample.
struct alignas(64) DirectionGroup {
    float x[kGroupSize] = {}, y[kGroupSize] = {}, z[kGroupSize] = {};
    float pdf_sa[kGroupSize] = {}, bsdf_pdf_sa[kGroupSize] = {};
    std::int32_t bin[kGroupSize] = {};

    DirectionSample get(std::uint32_t lane) const {
        return {{x[lane], y[lane], z[lane]}, pdf_sa[lane], bsdf_pdf_sa[lane], bin[lane]};
    }
};

/// Lights as plain pointers, a row of numbers per column.
struct LightColumns {
    /// The first of three columns, or the only one.
    static constexpr int kCorner0 = 0, kCorner1 = 3, kCorner2 = 6, kNormal = 9, kPositionError = 12, kPdfArea = 13,
                         kCumulative = 14, kCount = 15;

    const float* numbers;  ///< [column][light]
    std::uint32_t count;

    PL_INLINE const float* row(int column) const { return numbers + static_cast<std::uint32_t>(column) * count; }
};

/// 16 Lambert reflectors that lights are sampled for, and the numbers for it.
struct alignas(64) ReceiverGroup {
    VectorGroup position, geometric_normal, shading_normal;
    float position_error[kGroupSize] = {};
    float u[3][kGroupSize] = {};
};

/// A light sample for each of a ReceiverGroup, without emission.
struct alignas(64) LightSampleGroup {
    std::int32_t light[kGroupSize] = {};      ///< its number
    std::int32_t is_near[kGroupSize] = {};    ///< not 0: the light may be sampled by solid angle, this sample is none
    std::int32_t is_behind[kGroupSize] = {};  ///< not 0: its back is seen
    float cos_i[kGroupSize] = {};
    float pdf_sa[kGroupSize] = {};  ///< 0: nothing can be reflected
    VectorGroup weights;            ///< barycentric, on the light
    VectorGroup wi;
    VectorGroup origin, direction;  ///< of the shadow ray
};

struct LaneKernels {
    const char* isa;
    /// Closest hits of `groups` groups of rays, tested against all triangles.
    void (*find_closest)(const DenseView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t groups);
    void (*find_occluded)(const DenseView& scene, const RayGroup* rays, OcclusionMask* masks, std::uint32_t groups);
    /// Hits of the first `count` rays by the wide hierarchy.
    void (*find_closest_wide)(const WideView& scene, const RayGroup* rays, HitGroup* hits, std::uint32_t count);
    void (*find_occluded_wide)(const WideView& scene, const RayGroup* rays, OcclusionMask* masks,
                               std::uint32_t count);
    /// Evaluates Rng::draw() for every counter.
    void (*draw)(const DrawKey& key, const CounterGroup* counters, NumberGroup* numbers, std::uint32_t groups);
    /// Evaluates vertex_numbers() for every counter.
    void (*draw_vertices)(const DrawKey& key, const CounterGroup* counters, NumberGroup* numbers,
                          std::uint32_t groups);
    /// Samples table rows for sample_guided() and prefetches the columns it reads.
    void (*sample_rows)(const TableSampler& tables, const GuidedGroup& paths, SampledGroup& sampled);
    /// Guided::sample_direction() of every path, at Lambert reflectors.
    void (*sample_guided)(const TableSampler& tables, const GuidedGroup* paths, SampledGroup* sampled,
                          DirectionGroup* directions, std::uint32_t groups);
    /// Guided::pdf_sa() of the directions in `sampled`, at Lambert reflectors.
    void (*weigh_guided)(const TableSampler& tables, const GuidedGroup* paths, SampledGroup* sampled,
                         DirectionGroup* directions, std::uint32_t groups);
    /// Samples a light for every receiver.
    void (*sample_lights)(const LightColumns& lights, const ReceiverGroup* receivers, LightSampleGroup* samples,
                          std::uint32_t groups);
    /// Whether any cell of a volume has new training samples.
    bool (*has_samples)(const TableUpdateView& field, std::uint32_t volume);
    /// The update of one volume's table: update_volume() without the BSDF fraction and the reach. Returns false, and changes
    /// nothing, if the vectors do not fit the table's side.
    bool (*update_table)(const TableUpdateView& field, std::uint32_t volume);
};

extern const LaneKernels kLaneKernelsBaseline;
extern const LaneKernels kLaneKernelsAvx2;    ///< only in builds with PL_LANE_CLONES
extern const LaneKernels kLaneKernelsAvx512;  ///< only in builds with PL_LANE_CLONES

/// Kernels in this build that the machine supports, widest vectors last.
std::span<const LaneKernels> usable_lane_kernels();

inline const LaneKernels& best_lane_kernels() { return usable_lane_kernels().back(); }

}  // namespace pl
