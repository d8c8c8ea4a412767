// Checks of the learned field, and of the directions sampled from it.
#pragma once

#include "core/kernel/integrator/probe.h"
#include "core/kernel/methods/default.h"
#include "tests/mutants/small_field.h"
#include "tests/mutants/trace_many.h"
#include "tests/support/field/guided_methods.h"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Whether first vertices that train a field draw, after an update, numbers that are independent of those before it: the deviations of 8
/// passes and of the 8 that follow have no correlation. 20 000 pixels, seed 1; one of 0.06 would be seen.
inline Decision check_fresh_numbers() {
    const auto deviation = [](std::uint32_t pixel, std::uint32_t first, const VertexSequences& sequences) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < 8; ++i) {
            const Rng rng{1, Stream::Picture, pixel, first + 2 * i};
            sum += static_cast<double>(vertex_uniforms(rng, sequences, kSpreadVertex, Purpose::Scatter).y) - 0.5;
        }
        return sum / 8.0;
    };
    Moments product, square;
    for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
        const double before = deviation(pixel, 0, {});
        product.add(before * deviation(pixel, 16, {32, 16}));
        square.add(before * before);
    }
    const double z = product.mean() / product.standard_error();
    const std::string reason =
        "correlation " + std::to_string(product.mean() / square.mean()) + ", Z " + std::to_string(z);
    if (!(std::fabs(z) < kZAlpha)) return {Verdict::Fail, reason};
    return {product.standard_error() < resolving_error(0.06 * square.mean()) ? Verdict::Pass : Verdict::Inconclusive,
            reason};
}

/// The part of the unit cube in view of a cell of a volume on its floor, judged at 17 x 17 directions.
enum class Sees { WallX0, Others, Both };

/// Written without the direction map of core/kernel/fields, which may be the mutant.
inline Sees seen_by_cell(const TableField& field, std::int32_t volume, int cell, Vec3f origin) {
    constexpr int kSteps = 16;
    // Covers the gaps between the directions, and the spread of the paths' starting points.
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

/// The learned radiance of a volume on the floor is exactly 1 in cells that face only the bright wall, exactly 0 in those that
/// face none of it; there have to be eight of each kind at least.
inline Decision judge_cells(SmallField& field, std::int32_t volume, Vec3f origin) {
    const TableField view = field.view();
    int bright = 0;
    int dark = 0;
    int wrong = 0;
    for (int cell = 0; cell < view.cells.count(); ++cell) {
        const std::uint32_t index = view.cell_index(volume, cell);
        const Sees sees = seen_by_cell(view, volume, cell, origin);
        if (field.tables().visits[index] == 0 || sees == Sees::Both) continue;
        ++(sees == Sees::WallX0 ? bright : dark);
        wrong += field.tables().radiance[index] == (sees == Sees::WallX0 ? 1.0f : 0.0f) ? 0 : 1;
    }
    const std::string reason = std::to_string(bright) + " bright cells, " + std::to_string(dark) + " dark ones, " +
                               std::to_string(wrong) + " learned something else";
    if (wrong > 0) return {Verdict::Fail, reason};
    return {bright >= 8 && dark >= 8 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

/// A box whose only light is one wall; the other walls are black, the floor is gray.
inline HostScene box_with_bright_wall() {
    BoxLook look;
    look.albedo[kFloor] = Vec3f{0.5f};
    look.emission[kWallX0] = Vec3f{1.0f};
    return pack_scene(box_scene(look));
}

/// Cells filled by paths from the middle of the floor. Seed 1, 2e4 paths.
inline Decision check_learned_cells() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 12);
    trace_many<FeatureSet{}>(scene, camera_at_center(kFloor, kCubeLow, kCubeHigh), guided_by(field.view()),
                             {.seed = 1}, {0, 20'000}, [](const auto&, const auto&) {});
    field.update();
    const Vec3f middle = wall_center(kFloor, kCubeLow, kCubeHigh);
    return judge_cells(field, field.volume_at(middle, {0.0f, 1.0f, 0.0f}), middle);
}

/// Cells filled by precomputation: 4 x 4 strata each, seed 1.
inline Decision check_probed_cells() {
    const HostScene scene = box_with_bright_wall();
    const SceneView view = scene.view();
    SmallField field(scene, 30, 12);
    const TableField tables = field.view();
    const std::int32_t volume = field.volume_at(wall_center(kFloor, kCubeLow, kCubeHigh), {0.0f, 1.0f, 0.0f});
    const PathSettings settings{.seed = 1, .stream = Stream::Precompute};
    for (std::uint32_t probe = 0; probe < probe_count(tables); ++probe) {
        if (probe_target(tables, probe).volume != volume) continue;
        for (std::uint32_t sample = 0; sample < 16; ++sample) {
            PathCounters counters;
            auto state = begin_probe<FeatureSet{}>(tables, settings, probe, {sample, 4});
            trace_path<FeatureSet{}>(PathContext<ProbeMethod>{view, ProbeMethod{}, settings}, BvhIntersector{view},
                                     state, counters);
            finish_probe(tables, state, counters.method);
        }
    }
    field.update();
    return judge_cells(field, volume, field.site(volume).position);
}

inline CameraDescription camera_in_furnace() { return {.eye = Vec3f{0.0f}, .target = Vec3f{1.0f}}; }

/// 30 volumes of 16 cells in a furnace, after 64 passes of 1000 paths.
template <FeatureSet F>
SmallField field_of_furnace(const HostScene& scene, const PathSettings& settings) {
    SmallField field(scene, 30, 4);
    for (std::uint32_t pass = 0; pass < 64; ++pass) {
        trace_many<F>(scene, camera_in_furnace(), guided_by(field.view()), settings, {1000 * pass, 1000},
                      [](const auto&, const auto&) {});
        field.update();
    }
    return field;
}

/// In a furnace every target is a function of the learned radiance alone, so cells approach 1 without noise; the
/// error falls like 1/passes^2 here. 64 passes of 1000 paths, seed 1: every cell with samples in half of the passes
/// has to be within 2 %.
inline Decision check_furnace_cells() {
    SmallField field = field_of_furnace<FeatureSet{}>(pack_scene(furnace_scene(0.5f, 0.5f)), {.seed = 1});
    float worst = 0.0f;
    int cells = 0;
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i)
        if (field.tables().visits[i] >= 32) {
            worst = max_of(worst, std::fabs(field.tables().radiance[i] - 1.0f));
            ++cells;
        }
    const std::string reason = std::to_string(cells) + " cells, the worst off by " + std::to_string(worst);
    if (!(worst <= 0.02f)) return {Verdict::Fail, reason};
    return {cells > 100 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

/// With light samples, the irradiance learned from scattered directions and from light samples is together e/(1-rho) = 1 in
/// every volume that paths meet often.
inline Decision judge_irradiance(SmallField field) {
    float worst = 0.0f;
    int volumes = 0;
    for (std::size_t i = 0; i < field.tables().direct.size(); ++i)
        if (field.tables().direct_count[i] >= 2000) {
            worst = max_of(worst, std::fabs(field.tables().mean_radiance[i] + field.tables().direct[i] - 1.0f));
            ++volumes;
        }
    const std::string reason = std::to_string(volumes) + " volumes, the worst off by " + std::to_string(worst);
    if (!(worst <= 0.1f)) return {Verdict::Fail, reason};
    return {volumes > 10 ? Verdict::Pass : Verdict::Inconclusive, reason};
}

inline Decision check_furnace_lights() {
    return judge_irradiance(
        field_of_furnace<kWithNextEvent>(pack_scene(furnace_scene(0.5f, 0.5f)), {.seed = 1, .next_event = 1}));
}

/// The same where lights are chosen by the learned irradiance of clusters, and the radiance of paths there, by rule S1. Seed 1, 64 passes of
/// 1000 paths and 2e5 more, resolves 1 %.
inline Decision check_furnace_many_lights() {
    constexpr FeatureSet kManyLights = kWithNextEvent.with(Feature::ManyLights);
    constexpr PathSettings kSettings{.seed = 1, .next_event = 1};
    const HostScene scene = pack_scene(with_quartered_triangles(furnace_scene(0.5f, 0.5f)));
    SmallField field = field_of_furnace<kManyLights>(scene, kSettings);
    if (field.shape().light_clusters != kMostLightClusters) return {Verdict::Inconclusive, "no light tree"};
    Moments radiance;
    trace_many<kManyLights>(
        scene, camera_in_furnace(), guided_by(field.view()), kSettings, {64'000, 200'000},
        [&](const auto& state, const auto&) { radiance.add(static_cast<double>(state.radiance.x)); });
    return worse_of(mean_equals(radiance, {1.0, 1e-4}, 0.01), judge_irradiance(std::move(field)));
}

/// Mixture samples on the floor follow the mixture's density, by rule S3 on quarters of cells, in which the bilinear
/// density is integrated exactly by its value in the middle. Seed 1, 3e6 samples, resolves 1.2 %.
inline Decision check_mixture_density() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 8);
    Uniforms radiances(7);
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i) {
        field.tables().radiance[i] = radiances.next() < 0.5f ? 0.0f : radiances.next();
        field.tables().visits[i] = 1000;
    }
    field.update();
    const ReinforcementMethod method = guided_by(field.view(), {.learned = 0, .bsdf_fraction = 0.3f});
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
        const DirectionSample sample = method.sample_direction({volume}, surface, numbers_of(rng, 1));
        const Vec3f local{glm::dot(sample.wi, frame.x), glm::dot(sample.wi, frame.y), glm::dot(sample.wi, frame.z)};
        if (!is_finite(local)) return {Verdict::Fail, "a sampled direction is not finite"};
        ++observed[static_cast<std::size_t>(bins.cell_of(cosine_hemisphere_to_square(local)))];
    }
    return follows_density(observed, expected, 0.012);
}

/// Every cell of a table keeps at least its share of the uniform floor, also when all light comes through one cell.
inline Decision check_floor() {
    const HostScene scene = box_with_bright_wall();
    SmallField field(scene, 30, 8);
    for (std::size_t i = 0; i < field.tables().radiance.size(); ++i) {
        field.tables().radiance[i] = i % 64 == 10 ? 1.0f : 0.0f;
        field.tables().visits[i] = 1'000'000;
    }
    field.update();
    const DirectionTable table(field.view(), 0);
    float least = 1.0f;
    for (int cell = 0; cell < 64; ++cell) least = min_of(least, table.cell_probability(cell % 8, cell / 8));
    // Probabilities are differences of cumulative sums up to 1, in two steps: 4 roundoffs, 8 columns per row.
    const float share = field.shape().uniform_floor / 64.0f - 32.0f * kRoundoff;
    return {least >= share ? Verdict::Pass : Verdict::Fail,
            "least probability " + std::to_string(least) + ", floor " + std::to_string(share)};
}

}  // namespace pl::test
