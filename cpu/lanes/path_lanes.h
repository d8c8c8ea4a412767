// The steps of the integrator for vectors of paths that meet Lambert reflectors: camera rays, vertices, and shadow rays that are packed
// into a batch. Included by one file per instruction set; see lanes.h. Bit-identical to camera_ray() and to the steps of one path
// (core/kernel/integrator).
#pragma once

#include "core/kernel/integrator/roulette.h"
#include "core/kernel/integrator/steps.h"
#include "cpu/lanes/group_rows.h"
#include "cpu/lanes/vertex_lanes.h"

namespace pl {
namespace {

/// The vertices that paths reach.
class ReachLanes : GroupRows {
public:
    PL_INLINE ReachLanes(const SurfaceRows& scene, const BlockRows& block, std::uint32_t group, std::uint32_t first)
        : GroupRows(first), scene_(scene), hits_(block.hits[group]), points_(block.points[group]),
          material_(scene.materials, integers(points_.material)) {}

    /// Surface points and reflectances, for the lanes that hit a surface.
    PL_INLINE void find_surfaces(VertexGroup& vertices) const {
        const Real3<Lanes> normal = vector(points_.geometric_normal);
        store(vector(points_.position), vertices.position);
        store(normal, vertices.geometric_normal);
        store(scene_.triangle_normals == nullptr ? normal : smooth_normal(normal), vertices.shading_normal);
        store(row(points_.position_error), vertices.position_error);
        store(integers(hits_.primitive), vertices.primitive);
        store(albedo(), vertices.albedo);
    }
    PL_INLINE std::uint32_t hit() const {
        return bits(integers(hits_.primitive) != static_cast<std::int32_t>(kNoPrimitive));
    }
    PL_INLINE std::uint32_t emits() const {
        const LaneInt shines = ~is_black(material_.vector(offsetof(Material, emission)));
        const LaneInt both_sides = material_.integer(offsetof(Material, two_sided_emission));
        return bits(shines & ((integers(points_.front) != 0) | (both_sides != 0)));
    }
    PL_INLINE std::uint32_t scatters() const { return bits(~is_black(albedo())); }
    /// Counts the vertices. Marks the vertices from `max_depth` on.
    PL_INLINE std::uint32_t count(std::uint32_t max_depth, CounterGroup& counters, PathGroup& paths) const {
        const auto vertices = load_lanes<LaneUint>(paths.vertices + first()) + 1u;
        store_lanes(vertices, paths.vertices + first());
        store_lanes(load_lanes<LaneUint>(counters.vertex + first()) + 1u, counters.vertex + first());
        return bits(vertices >= max_depth);
    }

private:
    PL_INLINE std::uint32_t bits(const LaneInt& mask) const { return mask_bits(mask) << first(); }
    PL_INLINE Real3<Lanes> albedo() const { return material_.vector(offsetof(Material, albedo)); }

    /// The shading normal of with_shading_normal(), in lanes.
    PL_INLINE Real3<Lanes> smooth_normal(const Real3<Lanes>& geometric_normal) const {
        const LaneInt hit = integers(hits_.primitive);
        const LaneInt primitive = select(hit == static_cast<std::int32_t>(kNoPrimitive), LaneInt{}, hit);
        const Words<TriangleNormals> triangle(scene_.triangle_normals, primitive);
        const CornersOf<Lanes> normals{normal_of(triangle.integer(offsetof(TriangleNormals, n0))),
                                       normal_of(triangle.integer(offsetof(TriangleNormals, n1))),
                                       normal_of(triangle.integer(offsetof(TriangleNormals, n2)))};
        const LaneFloat b1 = row(hits_.b1);
        const LaneFloat b2 = row(hits_.b2);
        const Real3<Lanes> n = normals.at({1.0f - b1 - b2, b1, b2});
        const Real3<Lanes> front =
            Words<TrianglePlane>(scene_.planes, primitive).vector(offsetof(TrianglePlane, normal));
        return turned_to(geometric_normal, unit_or(n, front));
    }
    PL_INLINE Real3<Lanes> normal_of(const LaneInt& number) const {
        return Words<Vec3f>(scene_.normals, number).vector(0);
    }

    const SurfaceRows& scene_;
    const HitGroup& hits_;
    const PointGroup& points_;
    const Words<Material> material_;
};

PL_INLINE void copy_rows(const UniformGroup& uniforms, VectorGroup& to) {
    for (std::uint32_t lane = 0; lane < kGroupSize; lane += kLaneWidth) {
        store_lanes(load_lanes<LaneFloat>(uniforms.rows[0] + lane), to.x + lane);
        store_lanes(load_lanes<LaneFloat>(uniforms.rows[1] + lane), to.y + lane);
        store_lanes(load_lanes<LaneFloat>(uniforms.rows[2] + lane), to.z + lane);
    }
}

void reach_vertices(const SurfaceRows& scene, std::uint32_t max_depth, const BlockRows& block, SegmentMarks& marks) {
    for (std::uint32_t group = 0; group < block.groups; ++group) {
        std::uint32_t hit = 0, emits = 0, scatters = 0, is_deepest = 0;
        VertexGroup& vertices = block.vertices[group];
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) {
            const ReachLanes lanes(scene, block, group, first);
            lanes.find_surfaces(vertices);
            hit |= lanes.hit();
            emits |= lanes.emits();
            scatters |= lanes.scatters();
            is_deepest |= lanes.count(max_depth, block.counters[group], block.paths[group]);
        }
        marks.hit.groups[group] = static_cast<std::uint16_t>(hit);
        marks.emits.groups[group] = static_cast<std::uint16_t>(emits);
        marks.scatters.groups[group] = static_cast<std::uint16_t>(scatters);
        marks.is_deepest.groups[group] = static_cast<std::uint16_t>(is_deepest);
        copy_rows(block.scatter[group], vertices.scatter);
        if (block.light == nullptr) continue;
        std::memcpy(&vertices.light, &block.light[group], sizeof vertices.light);
        std::memcpy(&vertices.throughput, &block.paths[group].throughput, sizeof vertices.throughput);
    }
}

/// Steps at the vertices of a group of paths.
class PathLanes : GroupRows {
public:
    PL_INLINE PathLanes(const BlockRows& block, std::uint32_t group, std::uint32_t first)
        : GroupRows(first), vertices_(block.vertices[group]), paths_(block.paths[group]) {}

    /// Returns the lanes whose paths go on. `estimates`: contribution estimates; null: PathState::survival.
    PL_INLINE std::uint32_t play_roulette(const PathSettings& settings, const UniformGroup& uniforms,
                                          const float* estimates) const {
        const LaneFloat survival = row(paths_.survival) * max_component(vector(vertices_.albedo));
        const auto counted =
            load_lanes<LaneUint>(paths_.vertices + first()) - load_lanes<LaneUint>(paths_.specular + first());
        const LaneInt plays = counted >= settings.roulette_start;
        const RouletteRound<Lanes> round = pl::play_roulette<Lanes>(
            settings, estimates == nullptr ? survival : row(estimates), survival, row(uniforms.rows[3]));
        const LaneFloat weight = select(plays, round.weight, broadcast(1.0f));
        store(weight, paths_.roulette_weight);
        store(select(plays, round.survival, survival), paths_.survival);
        store(scaled(vector(paths_.throughput), weight), paths_.throughput);
        return mask_bits(~(plays & round.ends)) << first();
    }

    /// Scatters the paths of `lanes` into their directions, see scatter_lambert(). Returns the lanes of the paths
    /// that are lit by it.
    PL_INLINE std::uint32_t scatter(const DirectionGroup& directions, std::uint32_t lanes, RayGroup& rays) const {
        const Real3<Lanes> wi = vector(directions.wi);
        const VertexLanes::Scattered to = VertexLanes(vertices_, first()).scatter(directions);
        store(to.weight, paths_.weight);
        const Real3<Lanes> throughput = vector(paths_.throughput);
        const LaneInt scattered = lanes_of(lanes);
        store(select(scattered, product(throughput, to.weight), throughput), paths_.throughput);
        store(row(directions.pdf_sa), paths_.direction_pdf_sa);
        store(to.origin.x, rays.origin_x);
        store(to.origin.y, rays.origin_y);
        store(to.origin.z, rays.origin_z);
        store(wi.x, rays.direction_x);
        store(wi.y, rays.direction_y);
        store(wi.z, rays.direction_z);
        store(integers(vertices_.primitive), rays.source);
        return mask_bits(to.is_lit & scattered) << first();
    }

private:
    const VertexGroup& vertices_;
    PathGroup& paths_;
};

/// Calls step(lanes, group), which returns bits of lanes, for every vector of every group of a block.
template <class Step>
PL_INLINE void mark_path_lanes(const BlockRows& block, BlockBits& marks, const Step& step) {
    for (std::uint32_t group = 0; group < block.groups; ++group) {
        std::uint32_t bits = 0;
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            bits |= step(PathLanes(block, group, first), group);
        marks.groups[group] = static_cast<std::uint16_t>(bits);
    }
}

#if defined(__AVX512F__)
/// Appends the lanes of a vector that are in `lanes` to a row that is full up to lane `begin`; `next`: the row of the next group.
struct RowPacking {
    std::uint16_t lanes;
    std::uint32_t begin;
    bool reaches_next;

    PL_INLINE void append(const void* row, void* here, void* next) const {
        LaneInt order;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) order[lane] = static_cast<std::int32_t>(lane);
        order = (order - static_cast<std::int32_t>(begin)) & static_cast<std::int32_t>(kLaneWidth - 1);
        const auto values = std::bit_cast<__m512i>(load_lanes<LaneInt>(static_cast<const std::int32_t*>(row)));
        const __m512i packed = _mm512_maskz_compress_epi32(lanes, values);
        const __m512i turned = _mm512_maskz_permutexvar_epi32(0xffff, std::bit_cast<__m512i>(order), packed);
        _mm512_mask_storeu_epi32(here, static_cast<__mmask16>(0xffffu << begin), turned);
        if (reaches_next) _mm512_storeu_si512(next, turned);
    }
};
#endif

/// Appends the shadow rays of `lanes` to a batch of `count` rays.
PL_INLINE void append_shadow_rays(const LightSampleGroup& samples, const std::uint32_t* sources, std::uint32_t lanes,
                                  RayGroup* rays, std::uint32_t count) {
#if defined(__AVX512F__)
    const std::uint32_t begin = count % kGroupSize;
    const bool reaches_next = begin + static_cast<std::uint32_t>(std::popcount(lanes)) > kGroupSize;
    const RowPacking packing{static_cast<std::uint16_t>(lanes), begin, reaches_next};
    RayGroup& here = rays[count / kGroupSize];
    RayGroup& next = rays[count / kGroupSize + (reaches_next ? 1 : 0)];
    packing.append(samples.origin.x, here.origin_x, next.origin_x);
    packing.append(samples.origin.y, here.origin_y, next.origin_y);
    packing.append(samples.origin.z, here.origin_z, next.origin_z);
    packing.append(samples.direction.x, here.direction_x, next.direction_x);
    packing.append(samples.direction.y, here.direction_y, next.direction_y);
    packing.append(samples.direction.z, here.direction_z, next.direction_z);
    packing.append(sources, here.source, next.source);
    packing.append(samples.target, here.target, next.target);
#else
    for (; lanes != 0; lanes &= lanes - 1, ++count) {
        const auto from = static_cast<std::uint32_t>(std::countr_zero(lanes));
        const std::uint32_t to = count % kGroupSize;
        RayGroup& group = rays[count / kGroupSize];
        group.origin_x[to] = samples.origin.x[from];
        group.origin_y[to] = samples.origin.y[from];
        group.origin_z[to] = samples.origin.z[from];
        group.direction_x[to] = samples.direction.x[from];
        group.direction_y[to] = samples.direction.y[from];
        group.direction_z[to] = samples.direction.z[from];
        group.source[to] = sources[from];
        group.target[to] = samples.target[from];
    }
#endif
}

/// Packs the shadow rays of a block's samples that can contribute, of the paths in `lit`, and keeps their contributions with the paths.
/// Leaves in `lit` the paths that have one. `count`: of the rays in the batch, whose t_max is 1. Returns their number afterwards.
std::uint32_t pack_shadow_rays(const BlockRows& block, const LightSampleGroup* samples, BlockBits& lit,
                               VectorGroup* kept, RayGroup* rays, std::uint32_t count) {
    for (std::uint32_t group = 0; group < block.groups; ++group) {
        std::uint32_t lanes = 0;
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            lanes |= mask_bits(load_lanes<LaneFloat>(samples[group].pdf_sa + first) > 0.0f) << first;
        lanes &= lit.groups[group];
        lit.groups[group] = static_cast<std::uint16_t>(lanes);
        std::memcpy(&kept[group], &samples[group].contribution, sizeof kept[group]);
        append_shadow_rays(samples[group], block.vertices[group].primitive, lanes, rays, count);
        count += static_cast<std::uint32_t>(std::popcount(lanes));
    }
    return count;
}

/// Directions of the camera rays of a pinhole, which start at its eye.
PL_INLINE void find_camera_directions(const GroupRows& lanes, const Camera& camera, const PixelGrid& grid,
                                      const CounterGroup& counters, const UniformGroup& uniforms,
                                      VectorGroup& directions) {
    std::int32_t x[kLaneWidth], y[kLaneWidth];
    for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) {
        const std::uint32_t pixel = counters.pixel[lanes.first() + lane];
        x[lane] = static_cast<std::int32_t>(pixel % grid.width);
        y[lane] = static_cast<std::int32_t>(pixel / grid.width);
    }
    const Real2<Lanes> in_pixel =
        film_point<Lanes>({lanes.row(uniforms.rows[0]), lanes.row(uniforms.rows[1])}, sequence_steps(grid.sample));
    const Real2<Lanes> film{Lanes::to_real(load_lanes<LaneInt>(x)) + in_pixel.x,
                            Lanes::to_real(load_lanes<LaneInt>(y)) + in_pixel.y};
    const Vec2f resolution{static_cast<float>(grid.width), static_cast<float>(grid.height)};
    lanes.store(camera_direction(camera, film, resolution), directions);
}

void find_camera_directions(const Camera& camera, const PixelGrid& grid, const CounterGroup* counters,
                            const UniformGroup* uniforms, VectorGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            find_camera_directions(GroupRows(first), camera, grid, counters[group], uniforms[group],
                                   directions[group]);
}

void play_roulette(const PathSettings& settings, const BlockRows& block, const float* estimates,
                   BlockBits& continuing) {
    mark_path_lanes(block, continuing, [&](const PathLanes& lanes, std::uint32_t group) {
        const float* of_group = estimates == nullptr ? nullptr : estimates + group * kGroupSize;
        return lanes.play_roulette(settings, block.scatter[group], of_group);
    });
}

void scatter_paths(const BlockRows& block, const DirectionGroup* directions, RayGroup* rays, BlockBits& lit) {
    mark_path_lanes(block, lit, [&](const PathLanes& lanes, std::uint32_t group) {
        return lanes.scatter(directions[group], lit.groups[group], rays[group]);
    });
}

/// Adds contributions of light samples in `lanes`.
PL_INLINE void connect_lanes(const GroupRows& rows, const VectorGroup& lights, std::uint32_t lanes,
                             VectorGroup& radiance) {
    const Real3<Lanes> before = rows.vector(radiance);
    rows.store(select(rows.lanes_of(lanes), before + rows.vector(lights), before), radiance);
}

void connect_paths(const VectorGroup* lights, const BlockBits& lit, PathGroup* paths, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            connect_lanes(GroupRows(first), lights[group], lit.groups[group], paths[group].radiance);
}

}  // namespace
}  // namespace pl
