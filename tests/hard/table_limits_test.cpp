// What is learned at the limits: nothing, infinity, wrong numbers, thin walls, and runs that hardly end.
#include "core/fields/table_model.h"
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::array kLearners{kEstimators[2], kEstimators[3], kEstimators[4], kEstimators[5]};

template <class Array>
std::uint64_t count_not_finite(const Array& values) {
    std::uint64_t count = 0;
    for (const float value : values) count += std::isfinite(value) && value >= 0.0f ? 0 : 1;
    return count;
}

HostTables tables_after(const SceneDescription& scene, Estimator estimator, std::uint32_t passes) {
    Session session = make_session(scene, small_settings(scene, estimator, 32, 32));
    render_passes(session, passes);
    return tables_of(session.backend_access().download_field(estimator.method));
}

}  // namespace

TEST_CASE("In a dark room the learned radiance is zero, and directions stay possible", "[hard]") {
    BoxLook look;
    look.albedo.fill(glm::vec3{0.7f});
    const SceneDescription scene = box_scene(look);
    for (const Estimator estimator : kLearners) {
        INFO(estimator);
        const HostTables tables = tables_after(scene, estimator, 8);
        std::uint64_t lit = 0;
        for (const float value : tables.radiance) lit += value == 0.0f ? 0 : 1;
        CHECK(within(static_cast<double>(lit), 0.0));
        CHECK(worst_pixel(picture_of(scene, estimator, 16, 4), 0.0) == 0.0);
    }
}

// The true radiance is infinite: the learned one has to stay finite.
TEST_CASE("In a white closed room with a lamp the learned radiance stays finite", "[hard]") {
    for (const float emission : {1e-20f, 1.0f, 1e20f}) {
        const SceneDescription scene = furnace_scene(emission, 1.0f);
        for (const Estimator estimator : kLearners) {
            INFO("emission " << emission << ", " << estimator);
            const HostTables tables = tables_after(scene, estimator, 4);
            CHECK(count_not_finite(tables.radiance) == 0);
            CHECK(count_not_finite(tables.mean_radiance) == 0);
            CHECK(count_not_finite(tables.row_cdf) == 0);
            CHECK(count_not_finite(tables.column_cdf) == 0);
        }
    }
}

namespace {

/// Fills a session's tables with one number, as damaged memory or another program might.
void poison(Session& session, MethodId method, float value) {
    HostTables tables = tables_of(session.backend_access().download_field(method));
    for (LargeArray<float>* list :
         {&tables.radiance, &tables.mean_radiance, &tables.reach_weight, &tables.inverse_reach})
        for (float& entry : *list) entry = value;
    session.backend_access().upload_field(method, std::move(tables));
    session.backend_access().update_field(method);
}

}  // namespace

// Tables decide only directions: whatever they hold, the picture has to be the same. Seed 1, 1024 pixels, resolves 6 %.
TEST_CASE("Tables full of zeros, infinities, NaN or huge numbers leave the picture right", "[hard]") {
    const SceneDescription scene = furnace_scene(0.5f, 0.5f);
    for (const float value : {0.0f, kInfinity, kNan, -1.0f, 3e38f, 1e-45f}) {
        Session session = make_session(scene, small_settings(scene, kEstimators[4], 32, 32));
        render_passes(session, 2);
        poison(session, MethodId::Reinforcement, value);
        session.apply(EditRestart{});
        render_passes(session, 16);
        INFO("tables of " << value);
        const Snapshot picture = session.snapshot(slot_of(session));
        CHECK(count_broken(picture) == 0);
        CHECK(pixels_mean(picture, {1.0}, 0.06));
        CHECK(count_not_finite(tables_of(session.backend_access().download_field(MethodId::Reinforcement)).row_cdf) ==
              0);
    }
}

// Two volumes stand back to back on a sheet: training samples of one side must not reach the other.
TEST_CASE("The dark side of a sheet of no thickness learns nothing", "[hard]") {
    for (const float gap : {0.0f, 1e-5f}) {
        SceneDescription scene;
        scene.name = "sheet";
        scene.materials = {gray(0.5f), {.name = "lamp", .emission = Vec3f{10.0f}}};
        // A closed box, cut in two by a sheet; the lamp is in the upper half, the camera in the lower one.
        add_box(scene, {-1, -1, -1}, {1, 1, 1}, true);
        for (const float y : {0.0f, gap}) {
            add_own_quad(scene, {Vec3f{-1, y, -1}, {-1, y, 1}, {1, y, 1}, {1, y, -1}}, 0);
            if (gap == 0.0f) break;
        }
        add_own_quad(scene, {Vec3f{-0.2f, 0.9f, -0.2f}, {0.2f, 0.9f, -0.2f}, {0.2f, 0.9f, 0.2f}, {-0.2f, 0.9f, 0.2f}},
                     1);
        scene.camera = {.eye = {0.0f, -0.5f, 0.8f}, .target = {0.0f, -0.3f, 0.0f}, .fov_deg = 80.0f};
        for (const Estimator estimator : kEstimators) {
            INFO("gap " << gap << ", " << estimator);
            const Snapshot picture = picture_of(scene, estimator, 64, 16);
            CHECK(within(worst_pixel(picture, 0.0), 0.0));
            CHECK(picture.counters.path.escaped == 0);
        }
    }
}

TEST_CASE("The smallest and the largest fields go together with every rate", "[hard]") {
    const SceneDescription scene = furnace_scene(0.5f, 0.5f);
    for (const int volumes : {1, 2, 5000})
        for (const int bins : {4, 1024})
            for (const LearningRate rate : {LearningRate::SampleMean, LearningRate::Forgetful}) {
                RenderSettings settings = settings_for(scene, kEstimators[4], 16, 16);
                settings.field.volumes = volumes;
                settings.field.bins = bins;
                settings.field.rate = rate;
                Session session = make_session(scene, settings);
                render_passes(session, 4);
                CAPTURE(volumes, bins, static_cast<int>(rate));
                CHECK(count_broken(session.snapshot(slot_of(session))) == 0);
            }
}
