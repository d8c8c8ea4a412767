// Short versions of the statistical tests, to be run on kernels with a seeded defect: each decides on the true
// kernel, and each must fail on the defects that tests/mutants/CMakeLists.txt gives to it.
//   checks NAME            succeeds if the check passes
//   checks NAME --caught   succeeds if the check fails by its own rule; undecided is not caught
#include <iostream>
#include <string_view>

#include "core/kernel/integrator/probe.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/reinforcement.h"
#include "tests/mutants/small_field.h"
#include "tests/mutants/trace_many.h"
#include "tests/statistical/cube_radiosity.h"
#include "tests/statistical/rectangle_light.h"
#include "tests/statistical/rules.h"

namespace pl::test {
namespace {

constexpr Vec3f kCubeLow{0.0f};
constexpr Vec3f kCubeHigh{1.0f};

/// Rule S1 in every channel at the middle of a wall of a cube of known radiosity.
template <FeatureSet F, class M>
Decision check_cube_wall(const CubeReference& reference,
                         const HostScene& scene,
                         Wall wall,
                         const M& method,
                         Range samples,
                         double delta) {
    std::array<Moments, 3> channels;
    const PathSettings settings{.seed = 1, .next_event = F.has(Feature::NextEventEstimation) ? 1u : 0u};
    trace_many<F>(scene, camera_at_center(wall, kCubeLow, kCubeHigh), method, settings, samples,
                  [&](const PathState<M>& state, const PathCounters&) {
                      for (int c = 0; c < 3; ++c)
                          channels[static_cast<std::size_t>(c)].add(static_cast<double>(state.radiance[c]));
                  });
    Decision decision{Verdict::Pass, ""};
    for (int c = 0; c < 3; ++c) {
        const double truth = reference.center[wall][c];
        decision = worse_of(
            mean_equals(channels[static_cast<std::size_t>(c)], {truth, reference.error}, delta), decision);
    }
    return decision;
}

/// Floor of the cube under a bright ceiling, directions from the BSDF. Seed 1, 6e5 paths, resolves 2 %.
Decision check_cube() {
    const CubeReference reference = cube_with_bright_ceiling();
    return check_cube_wall<FeatureSet{}>(reference, pack_scene(cube_scene(reference)), kFloor,
                                         DefaultMethod{}, {0, 600'000}, 0.02);
}

/// A wall of the cube with a lamp, lights sampled as well. Seed 1, 4e5 paths, resolves 2 %.
Decision check_cube_next_event() {
    const CubeReference reference = cube_with_lamp();
    return check_cube_wall<kWithNextEvent>(reference, pack_scene(cube_scene(reference)), kWallX0,
                                           DefaultMethod{}, {0, 400'000}, 0.02);
}

/// The same with directions learned in 32 passes of 1000 paths. Seed 1, 7e5 paths, resolves 2 %.
Decision check_cube_guided() {
    const CubeReference reference = cube_with_lamp();
    const HostScene scene = pack_scene(cube_scene(reference));
    SmallField field(scene, 30, 8);
    const ReinforcementMethod method{{.field = field.view()}};
    for (std::uint32_t pass = 0; pass < 32; ++pass) {
        trace_many<FeatureSet{}>(scene, camera_at_center(kWallX0, kCubeLow, kCubeHigh), method, {.seed = 1},
                                 {1000 * pass, 1000}, [](const auto&, const auto&) {});
        field.publish();
    }
    return check_cube_wall<FeatureSet{}>(reference, scene, kWallX0, method, {1'000'000, 700'000}, 0.02);
}

/// Furnace with roulette from the first vertex on: survivals are geometric, so the radiance has mean e/(1-rho) and
/// variance e^2 rho/(1-rho)^2. Seed 1, 1e6 paths; the mean resolves 1 %, the variance 3 %.
Decision check_roulette() {
    constexpr double kRho = 0.5;
    Moments radiance, squared_deviation;
    trace_many<FeatureSet{}>(pack_scene(furnace_scene(0.5f, 0.5f)), CameraDescription{}, DefaultMethod{},
                             {.seed = 1, .roulette_start = 1}, {0, 1'000'000},
                             [&](const auto& state, const auto&) {
                                 const auto x = static_cast<double>(state.radiance.x);
                                 radiance.add(x);
                                 squared_deviation.add((x - 1.0) * (x - 1.0));
                             });
    return worse_of(mean_equals(radiance, {1.0}, 0.01), mean_equals(squared_deviation, {kRho}, 0.03));
}

/// Multiplies the albedos of everything that a path meets.
struct AlbedoProduct {
    BvhIntersector scene;
    Vec3d* product;

    Hit closest_hit(const Ray& ray) const {
        const Hit hit = scene.closest_hit(ray);
        if (hit.found())
            *product *= Vec3d{scene.scene.materials[scene.scene.triangles[hit.primitive].material].albedo};
        return hit;
    }
    bool occluded(const Ray& ray) const { return scene.occluded(ray); }
};

/// A box in equilibrium, emitting to the inside only, no roulette: a path brings 1 minus the product of the albedos
/// it met, whatever its directions. No sampling error, so the tolerance is rounding: 4 roundoffs per vertex. The
/// box stands off the origin, where offsets along normals are many roundoffs of its size. 2e5 paths, and not one
/// may be wrong or leave the box.
Decision check_equilibrium() {
    BoxLook look;
    look.albedo = {Vec3f{0.5f, 0.8f, 0.2f}, Vec3f{0.7f}, Vec3f{0.3f}, Vec3f{0.9f}, Vec3f{0.6f}, Vec3f{0.4f}};
    SceneDescription box = in_equilibrium(box_scene(look, Vec3f{40.0f}, Vec3f{41.0f}));
    for (MaterialDescription& material : box.materials)
        material.two_sided_emission = false;
    const HostScene scene = pack_scene(box);
    const SceneView view = scene.view();
    const PathSettings settings{.seed = 1, .max_depth = 24, .roulette_start = 1000};
    const PinholeCamera camera = make_camera(box.camera, 1, 1);
    constexpr std::uint32_t kPaths = 200'000;
    std::uint64_t wrong = 0;
    for (std::uint32_t sample = 0; sample < kPaths; ++sample) {
        Vec3d product{1.0};
        PathCounters counters;
        auto state = begin_path<DefaultMethod>(camera, settings, 1, 1, 0, sample);
        trace_path<FeatureSet{}>(view, AlbedoProduct{BvhIntersector{view}, &product}, DefaultMethod{},
                                 settings, state, counters);
        const double tolerance = 4.0 * (state.vertices + 1) * static_cast<double>(kRoundoff);
        const Vec3d off = glm::abs(Vec3d{state.radiance} - (Vec3d{1.0} - product));
        const bool right = off.x <= tolerance && off.y <= tolerance && off.z <= tolerance;
        wrong += right && counters.escaped == 0 ? 0 : 1;
    }
    return {wrong == 0 ? Verdict::Pass : Verdict::Fail,
            std::to_string(wrong) + " of " + std::to_string(kPaths) + " paths are wrong"};
}

/// Furnace paths that are cut after k vertices bring e (1 - rho^k) / (1 - rho), without sampling error: 4 roundoffs
/// per vertex. 1000 paths for each k up to 10.
Decision check_depth() {
    std::uint64_t wrong = 0;
    for (std::uint32_t depth = 1; depth <= 10; ++depth)
        trace_many<FeatureSet{}>(pack_scene(furnace_scene(0.5f, 0.5f)), CameraDescription{}, DefaultMethod{},
                                 {.seed = 1, .max_depth = depth, .roulette_start = 1000}, {0, 1000},
                                 [&](const auto& state, const auto&) {
                                     const float exact = 1.0f - std::pow(0.5f, static_cast<float>(depth));
                                     const float tolerance = 4.0f * static_cast<float>(depth + 1) * kRoundoff;
                                     wrong += std::fabs(state.radiance.x - exact) <= tolerance ? 0 : 1;
                                 });
    return {wrong == 0 ? Verdict::Pass : Verdict::Fail, std::to_string(wrong) + " of 10000 paths are wrong"};
}

/// A black plate hangs between a lamp and the floor: in its umbra the floor is black, exactly. 10000 paths.
Decision check_umbra() {
    SceneDescription lamp = lamp_above(0.1f, 0.05f).scene;
    lamp.materials.push_back({.name = "plate"});
    const std::uint32_t plate = add_vertex(lamp, {-5, 0.45f, -5});
    add_vertex(lamp, {-5, 0.45f, 5});
    add_vertex(lamp, {5, 0.45f, 5});
    add_vertex(lamp, {5, 0.45f, -5});
    add_quad(lamp, plate, plate + 1, plate + 2, plate + 3, 2);
    std::uint64_t lit = 0;
    std::uint64_t shadow_rays = 0;
    trace_many<kWithNextEvent>(pack_scene(lamp), lamp.camera, DefaultMethod{}, {.seed = 1, .next_event = 1},
                               {0, 10'000}, [&](const auto& state, const PathCounters& counters) {
                                   lit += is_black(state.radiance) ? 0 : 1;
                                   shadow_rays += counters.shadow_rays;
                               });
    const std::string reason =
        std::to_string(lit) + " paths are lit, " + std::to_string(shadow_rays) + " shadow rays";
    if (lit > 0)
        return {Verdict::Fail, reason};
    return {shadow_rays >= 10'000 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

/// What a cell of a volume on the floor of the unit cube sees, judged at 17 x 17 directions.
enum class Sees { WallX0, Others, Both };

/// Written without the direction map of core/kernel/fields, which may be the mutant.
Sees seen_by_cell(const FieldView& field, std::int32_t volume, int cell, Vec3f origin) {
    constexpr int kSteps = 16;
    // Covers what lies between two directions, and that paths do not all start in one point.
    constexpr float kMargin = 1.03f;
    const int side = field.cells.side;
    const Frame frame = field.frame(volume);
    int wall = 0;
    int others = 0;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
            const Vec2f at{static_cast<float>(cell % side) + static_cast<float>(i) / kSteps,
                           static_cast<float>(cell / side) + static_cast<float>(j) / kSteps};
            const Vec3f local = square_to_cosine_hemisphere(at * (1.0f / static_cast<float>(side)));
            const Vec3f d = local.x * frame.x + local.y * frame.y + local.z * frame.z;
            const float to_x0 = d.x < 0.0f ? -origin.x / d.x : kInfinity;
            const float to_top = (1.0f - origin.y) / d.y;
            const float to_z = (d.z < 0.0f ? -origin.z : 1.0f - origin.z) / d.z;
            const float to_others = min_of(to_top, to_z);
            wall += to_x0 * kMargin < to_others ? 1 : 0;
            others += to_x0 > to_others * kMargin ? 1 : 0;
        }
    constexpr int kAll = (kSteps + 1) * (kSteps + 1);
    return wall == kAll ? Sees::WallX0 : (others == kAll ? Sees::Others : Sees::Both);
}

/// What a volume on the floor learned is exactly 1 in cells that see only the bright wall, exactly 0 in those that see
/// none of it; there have to be eight of each kind at least.
Decision judge_cells(SmallField& field, std::int32_t volume, Vec3f origin) {
    const FieldView view = field.view();
    int bright = 0;
    int dark = 0;
    int wrong = 0;
    for (int cell = 0; cell < view.cells.count(); ++cell) {
        const std::uint32_t index = view.cell_index(volume, cell);
        const Sees sees = seen_by_cell(view, volume, cell, origin);
        if (field.tables().visits[index] == 0 || sees == Sees::Both)
            continue;
        ++(sees == Sees::WallX0 ? bright : dark);
        wrong += field.tables().radiance[index] == (sees == Sees::WallX0 ? 1.0f : 0.0f) ? 0 : 1;
    }
    const std::string reason = std::to_string(bright) + " bright cells, " + std::to_string(dark) +
                               " dark ones, " + std::to_string(wrong) + " learned something else";
    if (wrong > 0)
        return {Verdict::Fail, reason};
    return {bright >= 8 && dark >= 8 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

/// A box whose only light is one wall; the other walls are black, the floor is gray.
HostScene box_with_bright_wall() {
    BoxLook look;
    look.albedo[kFloor] = Vec3f{0.5f};
    look.emission[kWallX0] = Vec3f{1.0f};
    return pack_scene(box_scene(look));
}

/// Cells filled by paths from the middle of the floor. Seed 1, 2e4 paths.
Decision check_learned_cells() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 12);
    trace_many<FeatureSet{}>(scene, camera_at_center(kFloor, kCubeLow, kCubeHigh),
                             ReinforcementMethod{{.field = field.view()}}, {.seed = 1}, {0, 20'000},
                             [](const auto&, const auto&) {});
    field.publish();
    const Vec3f middle = wall_center(kFloor, kCubeLow, kCubeHigh);
    return judge_cells(field, field.volume_at(middle, {0.0f, 1.0f, 0.0f}), middle);
}

/// Cells filled by precomputation: 4 x 4 strata each, seed 1.
Decision check_probed_cells() {
    const HostScene scene = box_with_bright_wall();
    const SceneView view = scene.view();
    SmallField field(scene, 30, 12);
    const FieldView tables = field.view();
    const std::int32_t volume = field.volume_at(wall_center(kFloor, kCubeLow, kCubeHigh), {0.0f, 1.0f, 0.0f});
    const PathSettings settings{.seed = 1, .stream = Stream::Precompute};
    for (int cell = 0; cell < tables.cells.count(); ++cell)
        for (std::uint32_t sample = 0; sample < 16; ++sample) {
            PathCounters counters;
            auto state = begin_probe(tables, settings, tables.cell_index(volume, cell), sample, 4);
            trace_path<FeatureSet{}>(view, BvhIntersector{view}, DefaultMethod{}, settings, state, counters);
            finish_probe(tables, state);
        }
    field.publish();
    return judge_cells(field, volume, field.site(volume).position);
}

/// In a furnace every target is the fixed point's image of what is known, so cells approach 1 without noise; the
/// error falls like 1/passes^2 here. 64 passes of 1000 paths, seed 1: every cell with records in half of the passes
/// has to be within 2 %.
Decision check_furnace_cells() {
    const HostScene scene = pack_scene(furnace_scene(0.5f, 0.5f));
    SmallField field(scene, 30, 4);
    for (std::uint32_t pass = 0; pass < 64; ++pass) {
        trace_many<FeatureSet{}>(scene, CameraDescription{.eye = Vec3f{0.0f}, .target = Vec3f{1.0f}},
                                 ReinforcementMethod{{.field = field.view()}}, {.seed = 1},
                                 {1000 * pass, 1000}, [](const auto&, const auto&) {});
        field.publish();
    }
    float worst = 0.0f;
    int cells = 0;
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i)
        if (field.tables().visits[i] >= 32) {
            worst = max_of(worst, std::fabs(field.tables().radiance[i] - 1.0f));
            ++cells;
        }
    const std::string reason = std::to_string(cells) + " cells, the worst off by " + std::to_string(worst);
    if (!(worst <= 0.02f))
        return {Verdict::Fail, reason};
    return {cells > 100 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

/// Mixture samples on the floor follow the mixture's density, by rule S3 on quarters of cells, in which the bilinear
/// density is integrated exactly by its value in the middle. Seed 1, 3e6 samples, resolves 1.2 %.
Decision check_mixture_density() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 8);
    Uniforms radiances(7);
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i) {
        field.tables().radiance[i] = radiances.next() < 0.5f ? 0.0f : radiances.next();
        field.tables().visits[i] = 1000;
    }
    field.publish();
    const ReinforcementMethod method{{.field = field.view(), .bsdf_fraction = 0.3f}};
    const std::int32_t volume = field.volume_at({0.5f, 0.0f, 0.5f}, {0.0f, 1.0f, 0.0f});
    const SurfacePoint& surface = field.site(volume);
    const Frame frame = field.view().frame(volume);

    constexpr int kBins = 32;
    constexpr std::uint32_t kSamples = 3'000'000;
    std::vector<std::uint64_t> observed(kBins * kBins);
    std::vector<double> expected(kBins * kBins);
    const DirectionCells bins{kBins};
    for (int bin = 0; bin < bins.count(); ++bin) {
        const Vec3f wi = frame.to_world(square_to_cosine_hemisphere(bins.point_in_cell(bin, Vec2f{0.5f})));
        const float cosine = cosine_hemisphere_pdf_sa(glm::dot(wi, surface.shading_normal));
        expected[static_cast<std::size_t>(bin)] =
            static_cast<double>(method.pdf_sa({volume}, surface, wi) / cosine) * kSamples / bins.count();
    }
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const Rng rng{.seed = 1, .sample = i};
        const DirectionSample sample =
            method.sample_direction({volume}, surface, rng, 1, rng.draw(1, Purpose::Scatter));
        const Vec3f local{glm::dot(sample.wi, frame.x), glm::dot(sample.wi, frame.y),
                          glm::dot(sample.wi, frame.z)};
        ++observed[static_cast<std::size_t>(bins.cell_of_direction(local))];
    }
    return follows_density(observed, expected, 0.012);
}

/// Every cell of a table keeps at least its share of the uniform floor, also when all light comes through one cell.
Decision check_floor() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 8);
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i) {
        field.tables().radiance[i] = i % 64 == 10 ? 1.0f : 0.0f;
        field.tables().visits[i] = 1'000'000;
    }
    field.publish();
    const DirectionTable table(field.view(), 0);
    float least = 1.0f;
    for (int cell = 0; cell < 64; ++cell)
        least = min_of(least, table.cell_probability(cell % 8, cell / 8));
    // Probabilities are differences of cumulative sums up to 1, in two steps: 4 roundoffs, 8 columns per row.
    const float share = field.shape().uniform_floor / 64.0f - 32.0f * kRoundoff;
    return {least >= share ? Verdict::Pass : Verdict::Fail,
            "least probability " + std::to_string(least) + ", floor " + std::to_string(share)};
}

struct Check {
    std::string_view name;
    Decision (*run)();
};

constexpr Check kChecks[] = {
    {"cube", check_cube},
    {"cube-next-event", check_cube_next_event},
    {"cube-guided", check_cube_guided},
    {"roulette", check_roulette},
    {"equilibrium", check_equilibrium},
    {"depth", check_depth},
    {"umbra", check_umbra},
    {"learned-cells", check_learned_cells},
    {"probed-cells", check_probed_cells},
    {"furnace-cells", check_furnace_cells},
    {"mixture-density", check_mixture_density},
    {"floor", check_floor},
};

} // namespace
} // namespace pl::test

int main(int argc, char** argv) {
    const std::string_view name = argc > 1 ? argv[1] : "";
    const bool want_caught = argc > 2 && std::string_view(argv[2]) == "--caught";
    for (const pl::test::Check& check : pl::test::kChecks) {
        if (check.name != name)
            continue;
        const pl::test::Decision decision = check.run();
        std::cout << check.name << ": " << decision << "\n";
        return decision.verdict == (want_caught ? pl::test::Verdict::Fail : pl::test::Verdict::Pass) ? 0 : 1;
    }
    std::cerr << "no check is called '" << name << "'\n";
    return 2;
}
