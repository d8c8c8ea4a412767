// Sessions that learn by each of the representations: files, checkpoints, inspection, memory, and the fixed point of a furnace.
#include "core/diagnose/record_path.h"
#include "core/io/checkpoint_file.h"
#include "tests/core/session/through_file.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

std::vector<Representation> all_representations() {
    std::vector<Representation> all;
    for (const ChoiceInfo<Representation>& info : kRepresentations) all.push_back(info.value);
    return all;
}

/// Least of the largest sums of the shown shares of a volume, by quadrature over the volume's side: the lobe of the cosine reaches
/// below the surface, and the density of a tree has steps.
double least_largest_sum(Representation representation) {
    if (representation == Representation::Table) return 0.99;
    return representation == Representation::SdTree ? 0.8 : 0.7;
}

/// Words of the summary of a field, besides a number.
const char* words_of(Representation representation) {
    switch (representation) {
    case Representation::Table: return "64 directions";
    case Representation::SdTree: return "SD-tree of";
    case Representation::Lobes: return "up to 16 lobes";
    case Representation::Neural: return "8 lobes at each vertex by a network of ";
    }
    return "";
}

RenderSettings settings_of(Representation representation, const SceneDescription& scene, bool next_event = false) {
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, next_event});
    settings.field.representation = representation;
    return settings;
}

LargeArray<float> mean_radiance_of(const Session& session) {
    return std::visit([](const auto& arrays) { return arrays.mean_radiance; },
                      session.export_field(MethodId::Reinforcement).field);
}

/// Of the arrays beside the placement: arrays that volumes own, and arrays of a network; a tree has a few nodes.
std::size_t fewest_bytes(Representation representation, std::size_t volumes) {
    std::size_t bytes = 0;
    with_model(representation, [&]<class Model>() {
        bytes = volumes * bytes_by_volume<typename Model::template Storage<LargeArray>>({.cells = {8}});
        if constexpr (requires { Model::kBytesBesideVolumes; }) bytes += Model::kBytesBesideVolumes;
    });
    return std::max<std::size_t>(bytes, 10000);
}

}  // namespace

TEST_CASE("A session with any representation has the same bits for any number of threads") {
    const SceneDescription scene = shipped_scene("door");
    for (const Representation representation : all_representations())
        for (const bool next_event : {false, true}) {
            Session one = make_session(scene, settings_of(representation, scene, next_event), 1);
            render_passes(one, 6);
            const State expected = state_of(one);
            REQUIRE(std::ranges::any_of(mean_radiance_of(one), [](float mean) { return mean > 0.0f; }));
            if (const auto* tree = std::get_if<HostSdTree>(&expected.other)) REQUIRE(tree->first_node.size() > 8);
            for (const int threads : {2, 8}) {
                Session other = make_session(scene, settings_of(representation, scene, next_event), threads);
                render_passes(other, 6);
                CHECK(same_state(expected, state_of(other)));
            }
        }
}

TEST_CASE("A field of any representation that moved to another session through a file goes on with the same bits") {
    for (const Representation representation : all_representations()) {
        const SceneDescription scene = shipped_scene("door");
        const RenderSettings settings = settings_of(representation, scene);
        Session first = make_session(scene, settings, 2);
        render_passes(first, 3);
        const LearnedField field = first.export_field(MethodId::Reinforcement);
        CHECK_THAT(summary_of(field), contains(words_of(representation)) && contains("3 passes"));
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
}

/// Checks a checkpoint after three passes.
void check_checkpoint(const SceneDescription& scene, const RenderSettings& settings) {
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

TEST_CASE("A checkpoint of a session with any representation is continued with the same bits") {
    const SceneDescription scene = shipped_scene("door");
    for (const Representation representation : all_representations())
        check_checkpoint(scene, settings_of(representation, scene, true));
}

TEST_CASE("Other representations drop what was learned, and return to the same bits") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = settings_of(Representation::SdTree, scene);
    Session session = make_session(scene, settings, 2);
    render_passes(session, 3);
    const State expected = state_of(session);
    session.apply(EditField{small_settings(scene, {MethodId::Reinforcement, false}).field});
    render_passes(session, 2);
    CHECK(field_bytes(state_of(session).other) == 0);
    CHECK_FALSE(state_of(session).tables.radiance.empty());
    session.apply(EditField{settings.field});
    render_passes(session, 3);
    CHECK(same_state(expected, state_of(session)));
    // The map of probes keeps its tables beside the tree.
    render_passes(session, {MethodId::Precomputed, View::Beauty}, 1);
    CHECK_FALSE(state_of(session, {MethodId::Precomputed, View::Beauty}).tables.radiance.empty());
}

// Targets of all light in a furnace have no noise given V, and the quotient of V keeps it so: V comes to e/(1-rho) = 1.
// That of tables is in furnace_tables_test.cpp.
TEST_CASE("The irradiance beside any representation comes to that of the furnace") {
    for (const Representation representation : all_representations()) {
        if (representation == Representation::Table) continue;
        const SceneDescription scene = furnace_scene(0.5f, 0.5f);
        RenderSettings settings = settings_of(representation, scene);
        settings.field.volumes = 12;
        settings.field.learning.light = LearnedLight::All;
        Session session = make_session(scene, settings, 2);
        render_passes(session, 40);
        for (const float mean : mean_radiance_of(session)) CHECK(mean == Approx(1.0f).epsilon(0.005));
    }
}

/// Every data view of the field is valid, and of a closed box not dark.
void check_views(Session& session) {
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

TEST_CASE("The learned radiance of any representation is inspected, shown and counted") {
    for (const Representation representation : all_representations()) {
        const SceneDescription scene = shipped_scene("cornell");
        RenderSettings settings = settings_of(representation, scene);
        if (representation == Representation::SdTree) settings.field.budget_megabytes = 1.0;
        Session session = make_session(scene, settings, 2);
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
        CHECK(largest > least_largest_sum(representation));
        CHECK(largest < 1.4);
        const FieldStatus status = *session.field_status(MethodId::Reinforcement);
        CHECK(status.representation == representation);
        CHECK(status.network.has_value() == (representation == Representation::Neural));
        CHECK(status.bytes > fewest_bytes(representation, static_cast<std::size_t>(volumes)));
        CHECK((representation != Representation::SdTree || static_cast<double>(status.bytes) < 1.0e6));
        check_views(session);
    }
}

TEST_CASE("The number of volumes with lobes or a network is what the budget holds, that with lobes stays") {
    for (const Representation representation : all_representations()) {
        if (representation == Representation::SdTree) continue;
        const SceneDescription scene = shipped_scene("door");
        RenderSettings settings = settings_of(representation, scene);
        settings.field.volumes = 0;
        settings.field.bins = 16;
        // The network alone has 0.47.
        const double megabytes = representation == Representation::Neural ? 0.8 : 0.3;
        settings.field.budget_megabytes = megabytes;
        Session session = make_session(scene, settings, 2);
        render_passes(session, 20);
        const FieldStatus status = *session.field_status(MethodId::Reinforcement);
        CHECK((status.added_volumes == 0 || representation != Representation::Lobes));
        CHECK(static_cast<double>(status.bytes) < 1.0e6 * megabytes);
    }
}

TEST_CASE("A volume of any representation begins anew and learns again") {
    for (const Representation representation : all_representations()) {
        const SceneDescription scene = shipped_scene("cornell");
        Session session = make_session(scene, settings_of(representation, scene), 2);
        render_passes(session, 4);
        REQUIRE(mean_radiance_of(session)[3] > 0.0f);
        session.apply(EditForgetVolume{MethodId::Reinforcement, 3});
        CHECK(mean_radiance_of(session)[3] == 0.0f);
        render_passes(session, 2);
        CHECK(mean_radiance_of(session)[3] > 0.0f);
    }
}

// The field is frozen, so that all passes sampled what it holds now.
TEST_CASE("Paths guided by any representation are traced again with all vertices") {
    for (const Representation representation : all_representations()) {
        const SceneDescription scene = shipped_scene("cornell");
        Session session = make_session(scene, settings_of(representation, scene), 2);
        render_passes(session, 3);
        session.apply(EditLearning{MethodId::Reinforcement, LearningControl::Freeze});
        session.apply(EditRestart{});
        render_passes(session, 1);
        PassReplay passes = session.pass_replay(slot_of(session));
        const AnyFieldView field = diagnose::field_of(passes);
        const std::vector<Vec3f> pixels = session.snapshot(slot_of(session)).pixels;
        int guided = 0;
        for (std::uint32_t pixel = 0; pixel < 200; ++pixel) {
            const diagnose::PathRecord record = diagnose::record_path(passes, field, pixel, 0);
            guided += record.is_guided ? 1 : 0;
            CHECK(glm::length(record.radiance - pixels[pixel]) <= 1e-5f * glm::length(pixels[pixel]));
        }
        CHECK(guided == 200);
    }
}
