// Sessions that learn by lobes: files, checkpoints, inspection, memory, and the fixed point of a furnace.
#include "core/diagnose/record_path.h"
#include "core/io/checkpoint_file.h"
#include "tests/session/through_file.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

RenderSettings lobe_settings(const SceneDescription& scene, bool next_event = false) {
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, next_event});
    settings.field.representation = Representation::Lobes;
    return settings;
}

HostLobes lobes_of(const Session& session) {
    return std::get<HostLobes>(session.export_field(MethodId::Reinforcement).field);
}

}  // namespace

TEST_CASE("A session with lobes has the same bits for any number of threads") {
    const SceneDescription scene = shipped_scene("door");
    for (const bool next_event : {false, true}) {
        Session one = make_session(scene, lobe_settings(scene, next_event), 1);
        render_passes(one, 6);
        const State expected = state_of(one);
        REQUIRE(std::ranges::any_of(expected.lobes.total, [](float total) { return total > 0.0f; }));
        for (const int threads : {2, 8}) {
            Session other = make_session(scene, lobe_settings(scene, next_event), threads);
            render_passes(other, 6);
            CHECK(same_state(expected, state_of(other)));
        }
    }
}

TEST_CASE("Lobes that moved to another session through a file go on with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = lobe_settings(scene);
    Session first = make_session(scene, settings, 2);
    render_passes(first, 3);
    const LearnedField field = first.export_field(MethodId::Reinforcement);
    CHECK_THAT(summary_of(field), contains("up to 16 lobes") && contains("3 passes"));
    Session second = make_session(scene, small_settings(scene, {MethodId::Reinforcement, false}), 1);
    render_passes(second, 1);
    first.apply(EditRestart{});
    second.import_field(through_file(field));
    CHECK((second.settings().field == settings.field));
    for (int pass = 0; pass < 2; ++pass) {
        render_passes(first, 1);
        render_passes(second, 1);
        CHECK(same_state(state_of(first), state_of(second)));
    }
}

TEST_CASE("A checkpoint of a session with lobes is continued with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = lobe_settings(scene, true);
    Session whole = make_session(scene, settings, 2);
    render_passes(whole, 3);
    const TemporaryFolder folder;
    write_checkpoint(folder.path() / "c", {.seconds = 0.0, .state = whole.save_state()});
    Session next = make_session(scene, settings, 3);
    next.restore_state(read_checkpoint(folder.path() / "c").state);
    render_passes(whole, 3);
    render_passes(next, 3);
    CHECK(same_state(state_of(whole), state_of(next)));
}

// Targets of all light in a furnace have no noise given V, and the quotient of V keeps it so: V comes to e/(1-rho) = 1.
TEST_CASE("The irradiance beside lobes comes to that of the furnace") {
    const SceneDescription scene = furnace_scene(0.5f, 0.5f);
    RenderSettings settings = lobe_settings(scene);
    settings.field.volumes = 12;
    settings.field.learning.light = LearnedLight::All;
    Session session = make_session(scene, settings, 2);
    render_passes(session, 40);
    for (const float mean : lobes_of(session).mean_radiance) CHECK(mean == Approx(1.0f).epsilon(0.005));
}

TEST_CASE("What lobes have learned is inspected, shown and counted") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = make_session(scene, lobe_settings(scene), 2);
    render_passes(session, 8);
    const auto volumes = static_cast<std::int32_t>(session.field_status(MethodId::Reinforcement)->volumes);
    double largest = 0.0;
    for (std::int32_t volume = 0; volume < volumes; ++volume) {
        const VolumeInspection seen = session.inspect_volume(MethodId::Reinforcement, volume);
        double sum = 0.0;
        for (const float share : seen.probability) sum += share;
        largest = std::max(largest, sum);
        CHECK(sum >= 0.0);
        CHECK(seen.radiance.size() == 64);
        CHECK((seen.bsdf_fraction >= kMinBsdfFraction && seen.bsdf_fraction <= kMaxBsdfFraction));
    }
    // Of directions on the volume's side: the lobe of the cosine reaches below the surface. By quadrature.
    CHECK(largest > 0.7);
    CHECK(largest < 1.3);
    const FieldStatus status = *session.field_status(MethodId::Reinforcement);
    CHECK(status.representation == Representation::Lobes);
    CHECK(status.bytes > static_cast<std::size_t>(volumes) * lobe_bytes());
    for (const View view : {View::RadianceMap, View::Visits, View::Irradiance, View::Entropy, View::BsdfShare,
                            View::Change, View::Unvisited}) {
        render_passes(session, {MethodId::Reinforcement, view}, 1);
        const std::vector<Vec3f> pixels = session.snapshot({MethodId::Reinforcement, view}).pixels;
        INFO(info_of(view).name);
        // In a closed box no direction stays dark.
        CHECK((view == View::Unvisited ||
               std::ranges::any_of(pixels, [](Vec3f pixel) { return max_component(pixel) > 0.0f; })));
        CHECK(std::ranges::all_of(pixels, [](Vec3f pixel) { return is_valid_radiance(pixel); }));
    }
}

TEST_CASE("The number of volumes with lobes stays, and is what the budget holds") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = lobe_settings(scene);
    settings.field.volumes = 0;
    settings.field.bins = 16;
    settings.field.budget_megabytes = 0.3;
    Session session = make_session(scene, settings, 2);
    render_passes(session, 20);
    const FieldStatus status = *session.field_status(MethodId::Reinforcement);
    CHECK(status.added_volumes == 0);
    CHECK(static_cast<double>(status.bytes) < 0.3e6);
}

TEST_CASE("A volume with lobes begins anew and learns again") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = make_session(scene, lobe_settings(scene), 2);
    render_passes(session, 4);
    REQUIRE(lobes_of(session).mean_radiance[3] > 0.0f);
    session.apply(EditForgetVolume{MethodId::Reinforcement, 3});
    CHECK(lobes_of(session).mean_radiance[3] == 0.0f);
    CHECK(lobes_of(session).total[3] == 0.0f);
    render_passes(session, 2);
    CHECK(lobes_of(session).mean_radiance[3] > 0.0f);
}

// The field is frozen, so that all passes sampled what it holds now.
TEST_CASE("Paths guided by lobes are traced again with all vertices") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = make_session(scene, lobe_settings(scene), 2);
    render_passes(session, 3);
    session.apply(EditLearning{MethodId::Reinforcement, LearningControl::Freeze});
    session.apply(EditRestart{});
    render_passes(session, 1);
    PassReplay passes = session.pass_replay(slot_of(session));
    const AnyFieldView field = field_of(passes);
    const std::vector<Vec3f> pixels = session.snapshot(slot_of(session)).pixels;
    int guided = 0;
    for (std::uint32_t pixel = 0; pixel < 200; ++pixel) {
        const PathRecord record = record_path(passes, field, pixel, 0);
        guided += record.is_guided ? 1 : 0;
        CHECK(glm::length(record.radiance - pixels[pixel]) <= 1e-5f * glm::length(pixels[pixel]));
    }
    CHECK(guided == 200);
}
