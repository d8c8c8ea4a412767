// Paths that stay in SIMD lanes take the steps of the scalar code, bit for bit, by every instruction set.
#include "cpu/paths/vertices.h"

#include <cstring>

#include "tests/cpu/lanes/leaning_point.h"
#include "tests/cpu/rays/random_rays.h"
#include "tests/support/catch.hpp"
#include "tests/support/same_bits.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

using State = PathState<FeatureSet{}, DefaultMethod>;

bool has(std::uint64_t bits, std::uint32_t i) { return ((bits >> i) & 1u) != 0; }

/// The rows of one block, owned.
struct PathRows {
    RayGroup rays[kBlockGroups];
    HitGroup hits[kBlockGroups];
    PointGroup points[kBlockGroups];
    UniformGroup scatter[kBlockGroups];
    CounterGroup counters[kBlockGroups];
    PathGroup paths[kBlockGroups];
    VertexGroup vertices[kBlockGroups];

    BlockRows rows() {
        return {.hits = hits,
                .points = points,
                .scatter = scatter,
                .light = nullptr,
                .counters = counters,
                .paths = paths,
                .vertices = vertices,
                .groups = kBlockGroups};
    }
};

/// Triangles with and without reflectance, emission on no, one and both sides, and shading normals; one normal has no length.
HostScene scene_of_surfaces() {
    SceneDescription scene;
    scene.materials = {gray(0.5f), gray(0.0f), gray(0.2f), gray(0.0f)};
    scene.materials[0].albedo = glm::vec3(0.0f, 0.3f, 0.0f);
    scene.materials[2].emission = glm::vec3(0.0f, 0.0f, 2.0f);
    scene.materials[3].emission = glm::vec3(1.0f);
    scene.materials[3].two_sided_emission = true;
    scene.normals = {Vec3f{0.1f, 1.0f, 0.05f}, Vec3f{-0.3f, 0.9f, 0.2f}, Vec3f{0.5f, -0.4f, 0.6f}, Vec3f{0.0f}};
    Uniforms random(1);
    for (std::uint32_t i = 0; i < 60; ++i) {
        add_triangle(scene, random.cube(-1.0f, 1.0f), random.cube(-1.0f, 1.0f), random.cube(-1.0f, 1.0f), i % 4);
        if (i % 3 == 0) scene.triangles.back().normal = {0, 1, 2};
        if (i % 7 == 0) scene.triangles.back().normal = {3, 3, 3};
    }
    return pack_scene(scene);
}

struct Reached {
    int different = 0;
    int missed = 0, emitting = 0, black = 0, deepest = 0, leaning = 0;
};

template <FeatureSet F>
Reached reach(const LaneKernels& kernels, const SceneView& scene) {
    constexpr std::uint32_t kMostVertices = 5;
    const auto block = std::make_unique<PathRows>();
    Uniforms random(2);
    Reached seen;
    for (int round = 0; round < 50; ++round) {
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const Ray ray{.origin = random.cube(-1.0f, 1.0f), .direction = random.direction()};
            block->rays[i / kGroupSize].set(i % kGroupSize, ray);
            block->hits[i / kGroupSize].set(i % kGroupSize, BvhIntersector{scene}.closest_hit(ray));
            block->paths[i / kGroupSize].vertices[i % kGroupSize] = random.below(8);
            block->counters[i / kGroupSize].vertex[i % kGroupSize] = i;
        }
        PathGroup before[kBlockGroups];
        std::memcpy(before, block->paths, sizeof before);
        kernels.find_points(
            {.triangles = scene.triangles.data, .planes = scene.planes.data, .positions = scene.positions.data},
            block->rays, block->hits, block->points, kBlockGroups);
        SegmentMarks marks;
        kernels.reach_vertices(surface_rows<F>(scene), kMostVertices, block->rows(), marks);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const std::uint32_t lane = i % kGroupSize;
            const Hit hit = block->hits[i / kGroupSize].get(lane);
            const std::uint32_t vertices = before[i / kGroupSize].vertices[lane] + 1;
            bool same = has(marks.hit.bits(), i) == hit.found() &&
                        has(marks.is_deepest.bits(), i) == (vertices >= kMostVertices) &&
                        block->paths[i / kGroupSize].vertices[lane] == vertices &&
                        block->counters[i / kGroupSize].vertex[lane] == i + 1;
            seen.deepest += vertices >= kMostVertices ? 1 : 0;
            seen.missed += hit.found() ? 0 : 1;
            if (hit.found()) {
                const Ray ray = block->rays[i / kGroupSize].get(lane);
                const SurfacePoint surface = make_surface_point<F>(scene, hit, -ray.direction);
                const auto bsdf = make_bsdf<F>(scene, surface, hit_weights(hit), -ray.direction);
                const bool emits = !is_black(emitted_at<F>(scene, surface, hit_weights(hit)));
                const VertexGroup& to = block->vertices[i / kGroupSize];
                same = same && same_bits(to.position.get(lane), surface.position) &&
                       same_bits(to.geometric_normal.get(lane), surface.geometric_normal) &&
                       same_bits(to.shading_normal.get(lane), surface.shading_normal) &&
                       same_bits(to.position_error[lane], surface.position_error) &&
                       to.primitive[lane] == surface.primitive && same_bits(to.albedo.get(lane), bsdf.albedo()) &&
                       has(marks.emits.bits(), i) == emits && has(marks.scatters.bits(), i) == bsdf.scatters();
                seen.emitting += emits ? 1 : 0;
                seen.black += bsdf.scatters() ? 0 : 1;
                seen.leaning += surface.shading_normal == surface.geometric_normal ? 0 : 1;
            }
            seen.different += same ? 0 : 1;
        }
    }
    return seen;
}

/// Paths of any survival at surfaces of any albedo.
void fill_for_roulette(PathRows& block, float* estimates, Uniforms& random) {
    for (std::uint32_t i = 0; i < kPathBlock; ++i) {
        const std::uint32_t lane = i % kGroupSize;
        PathGroup& paths = block.paths[i / kGroupSize];
        paths.throughput.set(lane, random.cube(0.0f, 2.0f));
        paths.survival[lane] = random.next();
        paths.vertices[lane] = random.below(7);
        paths.specular[lane] = random.below(4) == 0 ? random.below(paths.vertices[lane] + 1) : 0;
        block.vertices[i / kGroupSize].albedo.set(lane, random.cube(0.0f, 1.0f));
        block.scatter[i / kGroupSize].rows[3][lane] = random.next();
        estimates[i] = random.below(20) == 0 ? kInfinity : random.between(0.0f, 2.0f);
    }
}

/// Default path tracing with any contribution estimate.
struct Estimates : DefaultMethod {
    float estimate = 0.0f;

    float estimate_contribution(const Vertex&, Vec3f, Vec3f, float, auto&) const { return estimate; }
};

struct Played {
    int different = 0;
    int ended = 0;
};

Played play(const LaneKernels& kernels, const PathSettings& settings, bool with_estimates) {
    const auto block = std::make_unique<PathRows>();
    Uniforms random(3);
    Played played;
    for (int round = 0; round < 60; ++round) {
        float estimates[kPathBlock];
        fill_for_roulette(*block, estimates, random);
        PathGroup before[kBlockGroups];
        std::memcpy(before, block->paths, sizeof before);
        BlockBits continuing;
        kernels.play_roulette(settings, block->rows(), with_estimates ? estimates : nullptr, continuing);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const std::uint32_t lane = i % kGroupSize;
            const PathGroup& from = before[i / kGroupSize];
            PathState<kLobeFeatures, Estimates> state;
            state.throughput = from.throughput.get(lane);
            state.survival = from.survival[lane];
            state.vertices = from.vertices[lane];
            state.specular_vertices = from.specular[lane];
            const Vec3f albedo = block->vertices[i / kGroupSize].albedo.get(lane);
            const float estimate = with_estimates ? estimates[i] : state.survival * max_component(albedo);
            const float u = block->scatter[i / kGroupSize].rows[3][lane];
            const float weight = play_roulette(Estimates{{}, estimate}, settings, {}, albedo, u, state);
            const PathGroup& to = block->paths[i / kGroupSize];
            bool same = has(continuing.bits(), i) == (weight > 0.0f);
            if (weight > 0.0f)
                same = same && same_bits(to.throughput.get(lane), state.throughput) &&
                       same_bits(to.survival[lane], state.survival) && same_bits(to.roulette_weight[lane], weight);
            played.different += same ? 0 : 1;
            played.ended += weight > 0.0f ? 0 : 1;
        }
    }
    return played;
}

void set_vertex(VertexGroup& group, std::uint32_t lane, const LeaningPoint& point) {
    group.position.set(lane, point.surface.position);
    group.geometric_normal.set(lane, point.surface.geometric_normal);
    group.shading_normal.set(lane, point.surface.shading_normal);
    group.position_error[lane] = point.surface.position_error;
    group.primitive[lane] = point.surface.primitive;
    group.albedo.set(lane, point.bsdf.albedo());
}

/// Directions of any kind, some without a density.
int different_scattered(const LaneKernels& kernels) {
    const auto block = std::make_unique<PathRows>();
    Uniforms random(4);
    int different = 0;
    for (int round = 0; round < 40; ++round) {
        DirectionGroup directions[kBlockGroups];
        std::vector<LeaningPoint> points;
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            points.push_back(random_point(random));
            set_vertex(block->vertices[i / kGroupSize], i % kGroupSize, points.back());
            block->paths[i / kGroupSize].throughput.set(i % kGroupSize, Vec3f{0.5f, 0.25f, 2.0f});
            const float pdf_sa = random.below(10) == 0 ? 0.0f : random.next();
            directions[i / kGroupSize].set(i % kGroupSize, {.wi = random.direction(), .pdf_sa = pdf_sa});
        }
        constexpr std::uint64_t kScattered = 0xfff7'0f3e'ffff'ffefu;
        BlockBits lit;
        lit.set(kScattered);
        kernels.scatter_paths(block->rows(), directions, block->rays, lit);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const std::uint32_t lane = i % kGroupSize;
            State state;
            state.throughput = {0.5f, 0.25f, 2.0f};
            if (!has(kScattered, i)) {
                const bool is_left = !has(lit.bits(), i) &&
                                     same_bits(block->paths[i / kGroupSize].throughput.get(lane), state.throughput);
                different += is_left ? 0 : 1;
                continue;
            }
            PathCounters counters;
            DefaultMethod::Sample none;
            const DirectionSample direction = directions[i / kGroupSize].get(lane);
            const PathStatus status = scatter_lambert(DefaultMethod{}, points[i], direction, state,
                                                      StepOutput<DefaultMethod>{none, counters});
            bool same = has(lit.bits(), i) == (status == PathStatus::Continues);
            const Ray ray = block->rays[i / kGroupSize].get(lane);
            if (status == PathStatus::Continues)
                same = same && same_bits(block->paths[i / kGroupSize].throughput.get(lane), state.throughput) &&
                       same_bits(block->paths[i / kGroupSize].direction_pdf_sa[lane], state.direction_pdf_sa) &&
                       same_bits(ray.origin, state.ray.origin) && same_bits(ray.direction, state.ray.direction) &&
                       ray.source == state.ray.source && ray.t_max == state.ray.t_max;
            different += same ? 0 : 1;
        }
    }
    return different;
}

/// Shadow rays of random lanes, block after block, and the place of each in the batch.
int different_shadow_rays(const LaneKernels& kernels) {
    const auto block = std::make_unique<PathRows>();
    Uniforms random(5);
    int different = 0;
    for (int round = 0; round < 20; ++round) {
        RayGroup rays[3 * kBlockGroups];
        std::vector<Ray> expected;
        std::uint32_t count = 0;
        for (int part = 0; part < 3; ++part) {
            const auto samples = std::make_unique<LightSampleGroup[]>(kBlockGroups);
            std::uint64_t wanted = 0;
            BlockBits lit;
            for (std::uint32_t i = 0; i < kPathBlock; ++i) {
                LightSampleGroup& group = samples[i / kGroupSize];
                const std::uint32_t lane = i % kGroupSize;
                const Ray ray{.origin = random.cube(-1.0f, 1.0f),
                              .direction = random.direction(),
                              .t_max = 1.0f,
                              .source = random.below(100),
                              .target = random.below(100)};
                group.origin.set(lane, ray.origin);
                group.direction.set(lane, ray.direction);
                group.target[lane] = ray.target;
                group.pdf_sa[lane] = static_cast<float>(random.below(3)) - 1.0f;
                group.contribution.set(lane, ray.direction);
                block->vertices[i / kGroupSize].primitive[lane] = ray.source;
                const bool is_reached = random.below(round % 4 == 0 ? 1000 : 3) != 0;
                lit.groups[i / kGroupSize] = static_cast<std::uint16_t>(lit.groups[i / kGroupSize] |
                                                                        (static_cast<unsigned>(is_reached) << lane));
                if (!is_reached || !(group.pdf_sa[lane] > 0.0f)) continue;
                wanted |= std::uint64_t{1} << i;
                expected.push_back(ray);
            }
            for (RayGroup& group : rays) std::fill_n(group.t_max, kGroupSize, 1.0f);
            VectorGroup kept[kBlockGroups];
            count = kernels.pack_shadow_rays(block->rows(), samples.get(), lit, kept, rays, count);
            different += lit.bits() == wanted && count == expected.size() ? 0 : 1;
            for_bits(wanted, [&](std::uint32_t i) {
                const std::uint32_t lane = i % kGroupSize;
                different +=
                    same_bits(kept[i / kGroupSize].get(lane), samples[i / kGroupSize].contribution.get(lane)) ? 0 : 1;
            });
        }
        for (std::uint32_t i = 0; i < expected.size(); ++i) {
            const Ray ray = rays[i / kGroupSize].get(i % kGroupSize);
            different += std::memcmp(&ray, &expected[i], sizeof ray) == 0 ? 0 : 1;
        }
    }
    return different;
}

}  // namespace

TEST_CASE("Every instruction set finds the vertices of the scalar code, bit for bit") {
    const HostScene scene = scene_of_surfaces();
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        const Reached flat = reach<FeatureSet{}>(kernels, scene.view());
        CHECK(flat.different == 0);
        CHECK(flat.leaning == 0);
        const Reached smooth = reach<features(Feature::SmoothNormals)>(kernels, scene.view());
        CHECK(smooth.different == 0);
        CHECK(smooth.leaning > 100);
        CHECK(smooth.missed > 100);
        CHECK(smooth.emitting > 100);
        CHECK(smooth.black > 100);
        CHECK(smooth.deepest > 100);
    }
}

TEST_CASE("Every instruction set plays the roulette of the scalar code, bit for bit") {
    for (const LaneKernels& kernels : usable_lane_kernels())
        for (const RouletteRule rule : {RouletteRule::Spare, RouletteRule::Albedo})
            for (const bool with_estimates : {false, true}) {
                INFO(kernels.isa << ", rule " << static_cast<int>(rule) << ", estimates " << with_estimates);
                const PathSettings settings{.roulette_threshold = 0.7f, .roulette = rule};
                const Played played = play(kernels, settings, with_estimates);
                CHECK(played.different == 0);
                CHECK(played.ended > 200);
            }
}

TEST_CASE("Every instruction set sends paths where the scalar code does, bit for bit") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        CHECK(different_scattered(kernels) == 0);
    }
}

TEST_CASE("Every instruction set packs the shadow rays of lanes in their order") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        CHECK(different_shadow_rays(kernels) == 0);
    }
}

TEST_CASE("Every instruction set adds light to the paths that see it alone") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        PathGroup paths[kBlockGroups];
        VectorGroup lights[kBlockGroups];
        BlockBits lit;
        Uniforms random(6);
        lit.set(0xa50f3c69ffff0001u);
        PathGroup before[kBlockGroups];
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            before[i / kGroupSize].radiance.set(i % kGroupSize, random.cube(0.0f, 1.0f));
            lights[i / kGroupSize].set(i % kGroupSize, random.cube(0.0f, 1.0f));
        }
        std::memcpy(paths, before, sizeof paths);
        kernels.connect_paths(lights, lit, paths, kBlockGroups);
        for (std::uint32_t i = 0; i < kPathBlock; ++i) {
            const std::uint32_t lane = i % kGroupSize;
            const Vec3f radiance = before[i / kGroupSize].radiance.get(lane);
            const Vec3f sum = radiance + lights[i / kGroupSize].get(lane);
            CHECK(paths[i / kGroupSize].radiance.get(lane) == (has(lit.bits(), i) ? sum : radiance));
        }
    }
}
