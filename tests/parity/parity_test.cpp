// CPU and CUDA side by side. Pictures of paths agree by rule S2; views without random choices
// agree pixel by pixel; an update with the same training samples is equal to the bit. Built twice: against the stand-in for the
// runtime, where CI runs it, and against the device, where run_on_device.sh does.
#include <cmath>

#include "core/scene/pack_scene.h"
#include "cuda/cuda_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 32;
constexpr int kBatches = 64;
constexpr double kResolution = 0.08;

Session make_cuda_session(const SceneDescription& scene, const RenderSettings& settings) {
    return Session(make_cuda_backend(), std::make_shared<const SceneDescription>(scene), settings);
}

Picture picture_of(Session session, std::uint32_t passes) {
    Picture picture(kSide, kSide);
    render_batches(session, picture, kBatches, passes);
    return picture;
}

/// Tables with training samples that no update has absorbed yet, the same for both back ends. No pending sum stays
/// empty, and some volumes have none.
HostTables tables_with_samples(const FieldShape& shape, std::size_t volumes) {
    HostTables tables = make_arrays<HostTables>(shape, volumes);
    const Rng rng{.seed = 3};
    for (std::uint32_t i = 0; i < tables.pending_sum.size(); ++i) {
        const Vec4f u = rng.draw(i, Purpose::Scatter);
        tables.pending_count[i] = u.x < 0.3f ? 0 : static_cast<std::uint32_t>(1.0f + 50.0f * u.x * u.x * u.x);
        const float radiance = shape.radiance_unit * u.y * u.y * u.y * static_cast<float>(tables.pending_count[i]);
        tables.pending_sum[i] = to_fixed_point(radiance, shape.radiance_unit);
        tables.visits[i] = static_cast<std::uint32_t>(1000.0f * u.z * u.z);
        tables.radiance[i] = tables.visits[i] == 0 ? 0.0f : shape.radiance_unit * u.w * u.w * u.w;
    }
    const auto steps = [](float value, float per_unit) { return static_cast<std::int64_t>(value * per_unit); };
    for (std::uint32_t i = 0; i < tables.pending_light.size(); ++i) {
        const Vec4f u = rng.draw(i, Purpose::Light);
        if (u.x < 0.2f) continue;
        tables.pending_direct_count[i] = 1 + static_cast<std::uint32_t>(100.0f * u.y);
        tables.pending_direct[i] = to_fixed_point(50.0f * shape.radiance_unit * u.z, shape.radiance_unit);
        for (std::uint32_t k = i * shape.light_clusters; k < (i + 1) * shape.light_clusters; ++k)
            tables.pending_cluster[k] = tables.pending_direct[i] / shape.light_clusters;
        tables.pending_light[i] = steps(1.0e4f * u.x, kReachStepsPerUnit);
        tables.pending_distance[i] = steps(1.0e4f * u.x * u.y, kReachStepsPerUnit);
        tables.pending_curvature[i] = steps(100.0f * u.z, kMixtureStepsPerUnit);
        tables.pending_slope[i] = steps(100.0f * u.z * (u.w - 0.5f), kMixtureStepsPerUnit);
    }
    return tables;
}

/// Share of pixels that differ by more than rounding.
double differing_share(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
    constexpr float kTolerance = 1.0e-4f;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!(std::fabs(a[i][c] - b[i][c]) <= kTolerance * (1.0f + std::fabs(a[i][c])))) {
                ++differing;
                break;
            }
    return static_cast<double>(differing) / static_cast<double>(a.size());
}

}  // namespace

// Seeds 1 and 2, 64 batches of 32 x 32 pixels, alpha 1e-6 per decision and channel; differences of 8 % are resolved.
TEST_CASE("Pictures of both back ends agree for every scene and method", "[merge]") {
    for (const char* name : {"cornell", "door", "furnace"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const Estimator estimator : kEstimators) {
            INFO(name << ", " << estimator);
            // Noisiest where only scattering finds the light.
            const std::uint32_t passes = estimator.next_event ? 8 : 32;
            const Picture cpu = picture_of(make_session(scene, quick_learner(scene, estimator, kSide, 1)), passes);
            const Picture cuda =
                picture_of(make_cuda_session(scene, quick_learner(scene, estimator, kSide, 2)), passes);
            CHECK(same_picture(cuda, cpu, kResolution));
        }
    }
}

TEST_CASE("Views of both back ends are equal but for rounding") {
    for (const char* name : {"cornell", "door", "furnace"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const ViewInfo& view : all_views()) {
            if (view.id == View::Beauty || view.needs_tables) continue;
            INFO(name << ", " << view.name);
            RenderSettings settings = quick_learner(scene, {MethodId::Default, false}, kSide, 1);
            settings.view = view.id;
            Session cpu = make_session(scene, settings);
            Session cuda = make_cuda_session(scene, settings);
            render_passes(cpu, 4);
            render_passes(cuda, 4);
            // A ray through an edge may land on its other side: that shows in a few pixels.
            CHECK(differing_share(cpu.snapshot(slot_of(cpu)).pixels, cuda.snapshot(slot_of(cuda)).pixels) < 0.005);
        }
    }
}

TEST_CASE("Frames are made of films as the host would make them, to the bit") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const ViewInfo& view : all_views()) {
        INFO(view.name);
        RenderSettings settings = quick_learner(scene, {MethodId::Reinforcement, false}, kSide, 1);
        settings.view = view.id;
        Session cuda = make_cuda_session(scene, settings);
        render_passes(cuda, 3);
        const Snapshot film = cuda.snapshot(slot_of(cuda));
        for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces}) {
            const DisplaySettings display{.exposure_ev = 1.5f, .curve = curve};
            const ShownFilm shown = cuda.show_film(slot_of(settings), display);
            CHECK(shown.range.high == shown_range(film).high);
            const FrameStyle style = frame_style(view.id, display, shown.range);
            const ToneTable table(style.curve);
            const std::uint32_t* pixels = shown.frame.pixels();
            std::size_t differing = 0;
            for (std::size_t i = 0; i < film.pixels.size(); ++i)
                differing += pixels[i] != frame_pixel(film.pixels[i], style, table.view()) ? 1u : 0u;
            CHECK(differing == 0);
        }
    }
}

TEST_CASE("An update with the same training samples is equal to the bit") {
    // With a light tree, so that every array has values.
    const SceneDescription description = shipped_scene("boxed-lights");
    const auto scene = std::make_shared<const HostScene>(pack_scene(description));
    const FieldSettings settings{.volumes = 300};
    const FieldShape shape = make_field_shape(*scene, settings);
    const auto volumes = std::make_shared<const HostVolumes>(place_volumes(*scene, settings));
    const HostTables samples = tables_with_samples(shape, volumes->normals.size());
    const auto updated = [&](RenderBackend& backend) {
        backend.upload_scene(scene);
        backend.upload_volumes(volumes, shape);
        backend.upload_field(MethodId::Reinforcement, samples);
        backend.update_field(MethodId::Reinforcement);
        return tables_of(backend.download_field(MethodId::Reinforcement));
    };
    const HostTables cpu = updated(*make_cpu_backend({.threads = 1}));
    CHECK(same_bits(updated(*make_cuda_backend()), cpu));
    // An array that the update leaves as it was would be compared to no purpose.
    int unchanged = 0;
    zip(cpu, samples, [&](const auto& after, const auto& before) { unchanged += same_bits(after, before) ? 1 : 0; });
    CHECK(unchanged == 0);
}

TEST_CASE("The same seed gives the same bits on the device") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const auto render = [&] {
            Session session = make_cuda_session(scene, quick_learner(scene, estimator, kSide, 1));
            render_passes(session, 4);
            return state_of(session);
        };
        CHECK(same_state(render(), render()));
    }
}

TEST_CASE("A material that is changed on the device gives the bits of a new session, also after a detour") {
    const SceneDescription scene = shipped_scene("cornell");
    SceneDescription coated = scene;
    coated.materials[0].kind = SurfaceKind::Plastic;
    coated.materials[0].roughness = 0.3f;
    for (const MethodId method : {MethodId::Default, MethodId::Reinforcement}) {
        INFO(info_of(method).name);
        const RenderSettings settings = quick_learner(scene, {method, true}, kSide, 1);
        Session fresh = make_cuda_session(coated, settings);
        render_passes(fresh, 2);
        const std::shared_ptr<RenderBackend> cuda = make_cuda_backend();
        Session session(cuda, std::make_shared<const SceneDescription>(scene), settings);
        render_passes(session, 2);
        session.apply(EditMaterial{0, coated.materials[0]});
        render_passes(session, 2);
        CHECK(same_state(state_of(fresh), state_of(session)));
        CHECK(session.served_kernel(slot_of(session)).name == fresh.served_kernel(slot_of(fresh)).name);
        // Changed while another back end renders.
        session.apply(EditMaterial{0, scene.materials[0]});
        session.apply(EditBackend{std::shared_ptr<RenderBackend>(make_cpu_backend({.threads = 1}))});
        session.apply(EditMaterial{0, coated.materials[0]});
        session.apply(EditBackend{cuda});
        render_passes(session, 2);
        CHECK(same_state(state_of(fresh), state_of(session)));
    }
}
