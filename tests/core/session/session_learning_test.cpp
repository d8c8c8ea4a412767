// Learning that is frozen, stepped and forgotten for single volumes: which bits of the field and of the picture follow.
#include <algorithm>
#include <numeric>

#include "tests/core/session/stopping_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

Session learner(bool next_event = false) {
    const SceneDescription scene = shipped_scene("door");
    return make_session(scene, small_settings(scene, {kLearner, next_event}));
}

HostTables tables_of(const Session& session) { return tables_of(session.export_field(kLearner).field); }

std::uint64_t visits_of(const HostTables& tables) {
    return std::accumulate(tables.visits.begin(), tables.visits.end(), std::uint64_t{0});
}

void control(Session& session, LearningControl control) { session.apply(EditLearning{kLearner, control}); }

/// A learner with a pass under way behind `complete` ones.
struct LearnerWithinPass {
    static constexpr std::uint32_t kPathsOfPass = 100;

    std::shared_ptr<StoppingBackend> backend = std::make_shared<StoppingBackend>();
    Session session{backend, std::make_shared<const SceneDescription>(shipped_scene("door")),
                    small_settings(shipped_scene("door"), {kLearner, false})};

    explicit LearnerWithinPass(std::uint32_t complete) {
        render_passes(session, complete);
        backend->stops_behind = kPathsOfPass;
        REQUIRE(session.advance(slot_of(session)) == Progress::Stopped);
        REQUIRE(session.passes(slot_of(session)) == complete);
    }
};

/// The volume with the most learned light.
std::int32_t brightest_volume(const Session& session) {
    const HostTables tables = tables_of(session);
    return static_cast<std::int32_t>(std::ranges::max_element(tables.mean_radiance) - tables.mean_radiance.begin());
}

float radiance_of(const Session& session, std::int32_t volume) {
    return session.inspect_volume(kLearner, volume).mean_radiance;
}

}  // namespace

TEST_CASE("a field that learns from six passes keeps their bits for all that follow") {
    Session six = learner();
    render_passes(six, 6);
    const HostTables learned = tables_of(six);

    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {kLearner, false});
    settings.learn_passes = 6;
    Session frozen = make_session(scene, settings);
    for (const std::uint32_t passes : {6u, 1u, 30u}) {
        render_passes(frozen, passes);
        CHECK(same_bits(tables_of(frozen), learned));
    }
    const std::optional<FieldStatus> status = frozen.field_status(kLearner);
    CHECK(status->passes == 6);
    CHECK(status->is_frozen);
    CHECK_FALSE(status->was_edited);
    CHECK(status->records == six.field_status(kLearner)->records);
    CHECK_FALSE(six.field_status(kLearner)->is_frozen);

    // The same path numbers as of a field that goes on, and so other pictures only by what was learned.
    Session endless = learner();
    render_passes(endless, 37);
    CHECK(frozen.passes(slot_of(frozen)) == 37);
    CHECK_FALSE(same_film(state_of(frozen), state_of(endless)));
}

TEST_CASE("a pass that does not train traces the paths of one that does") {
    struct Case {
        LearningTarget target;
        Representation representation = Representation::Table;
    };
    // Tables have a kernel for such passes, other representations do not.
    constexpr Case kCases[] = {{LearningTarget::ExpectedSarsa},
                               {LearningTarget::MonteCarlo},
                               {LearningTarget::ExpectedSarsa, Representation::SdTree},
                               {LearningTarget::ExpectedSarsa, Representation::Lobes},
                               {LearningTarget::ExpectedSarsa, Representation::Neural}};
    for (const std::string name : {"door", "boxed-lights", "plates"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const Case& c : kCases) {
            RenderSettings settings = small_settings(scene, {kLearner, true});
            settings.guiding = GuidingRule::Always;
            settings.field.learning.target = c.target;
            settings.field.representation = c.representation;
            // Behind the update after four passes both begin with new numbers, which are the same.
            Session trained = make_session(scene, settings);
            settings.learn_passes = 4;
            Session frozen = make_session(scene, settings);
            render_passes(trained, 5);
            render_passes(frozen, 4);
            const std::uint64_t records = frozen.field_status(kLearner)->records;
            render_passes(frozen, 1);
            INFO(name << ", representation " << static_cast<int>(c.representation));
            CHECK(frozen.field_status(kLearner)->records == records);
            CHECK(trained.field_status(kLearner)->records > records);
            CHECK(same_bits(trained.snapshot(slot_of(trained)).pixels, frozen.snapshot(slot_of(frozen)).pixels));
        }
    }
}

TEST_CASE("a field frozen by hand is that of a run with as many passes of learning") {
    Session by_hand = learner();
    render_passes(by_hand, 7);
    control(by_hand, LearningControl::Freeze);
    render_passes(by_hand, 9);
    CHECK(by_hand.settings().learn_passes == 7);
    CHECK_FALSE(by_hand.field_status(kLearner)->was_edited);

    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {kLearner, false});
    settings.learn_passes = by_hand.settings().learn_passes;
    Session by_option = make_session(scene, settings);
    render_passes(by_option, 16);
    CHECK(same_film(state_of(by_hand), state_of(by_option)));
    CHECK(same_bits(tables_of(by_hand), tables_of(by_option)));
}

TEST_CASE("a freeze within a pass waits for its end") {
    LearnerWithinPass learner_within_pass(3);
    Session& session = learner_within_pass.session;
    control(session, LearningControl::Freeze);
    CHECK_FALSE(session.field_status(kLearner)->is_frozen);
    render_passes(session, 1);
    CHECK(session.field_status(kLearner)->is_frozen);
    CHECK(session.field_status(kLearner)->passes == 4);
    render_passes(session, 2);
    Session whole = learner();
    render_passes(whole, 3);
    control(whole, LearningControl::Step);  // the last pass ends with an update here, too
    render_passes(whole, 1);
    CHECK(same_bits(tables_of(session), tables_of(whole)));
}

TEST_CASE("a freeze within a pass that does not train is one behind the last pass that does") {
    Session rare = learner();
    render_passes(rare, 16);
    std::uint64_t records = 0;
    while (rare.field_status(kLearner)->records > records) {  // until a well-trained field learns from no pass
        REQUIRE(rare.passes(slot_of(rare)) < 200);
        records = rare.field_status(kLearner)->records;
        render_passes(rare, 1);
    }
    const std::uint32_t complete = rare.passes(slot_of(rare)) - 1;

    LearnerWithinPass learner_within_pass(complete);
    Session& session = learner_within_pass.session;
    control(session, LearningControl::Freeze);
    CHECK(session.field_status(kLearner)->is_frozen);
    const HostTables frozen = tables_of(session);
    render_passes(session, 20);
    CHECK(session.field_status(kLearner)->records == records);
    CHECK(same_bits(tables_of(session), frozen));
}

TEST_CASE("a step learns from one pass, and from no training sample of the frozen ones before it") {
    Session session = learner();
    render_passes(session, 4);
    const std::uint64_t each = session.field_status(kLearner)->records / 4;
    control(session, LearningControl::Freeze);
    render_passes(session, 11);
    const std::uint64_t records = session.field_status(kLearner)->records;
    const std::uint64_t visits = visits_of(tables_of(session));
    control(session, LearningControl::Step);
    render_passes(session, 6);
    const std::optional<FieldStatus> status = session.field_status(kLearner);
    CHECK(status->passes == 5);
    CHECK(status->is_frozen);
    CHECK(status->was_edited);
    const std::uint64_t added = status->records - records;
    CHECK(added > each / 2);
    CHECK(added < each * 2);
    CHECK(visits_of(tables_of(session)) - visits <= added);  // light seen directly has no cell
    CHECK(visits_of(tables_of(session)) > visits);
    control(session, LearningControl::Continue);
    render_passes(session, 2);
    CHECK(session.field_status(kLearner)->passes == 7);
    CHECK_FALSE(session.field_status(kLearner)->is_frozen);
}

TEST_CASE("a forgotten volume is as a new one, and all others keep their bits") {
    Session session = learner(true);
    render_passes(session, 6);
    const HostTables before = tables_of(session);
    const LearnedField field = session.export_field(kLearner);
    const HostTables fresh = make_arrays<HostTables>(field.shape, volume_count(before));
    const std::int32_t volume = brightest_volume(session);
    session.apply(EditForgetVolume{kLearner, volume});
    const HostTables after = tables_of(session);
    std::size_t changed = 0;
    for_each_array_of<HostTables>([&](const auto& spec) {
        const std::size_t length = spec.owner.count(field.shape);
        for (std::size_t i = 0; i < spec.get(after).size(); ++i) {
            const bool is_forgotten = i / std::max<std::size_t>(length, 1) == static_cast<std::size_t>(volume);
            const auto expected = is_forgotten ? spec.get(fresh)[i] : spec.get(before)[i];
            changed += spec.get(after)[i] != spec.get(before)[i] ? 1 : 0;
            if (spec.get(after)[i] != expected) FAIL_CHECK(spec.name << ", value " << i);
        }
    });
    CHECK(changed > 0);
    CHECK(session.passes(slot_of(session)) == 6);
    CHECK(session.field_status(kLearner)->was_edited);
    render_passes(session, 2);
    CHECK(radiance_of(session, volume) > 0.0f);  // it has learned again
}

TEST_CASE("a volume is forgotten between passes") {
    LearnerWithinPass learner_within_pass(6);
    Session& session = learner_within_pass.session;
    const std::int32_t volume = brightest_volume(session);
    session.apply(EditForgetVolume{kLearner, volume});
    CHECK(radiance_of(session, volume) > 0.0f);
    control(session, LearningControl::Freeze);
    render_passes(session, 1);  // the pass under way, as it was begun
    CHECK(radiance_of(session, volume) > 0.0f);
    render_passes(session, 1);  // frozen: it learns nothing again
    CHECK(radiance_of(session, volume) == 0.0f);
}

TEST_CASE("learning is controlled only where there is some") {
    Session session = learner();
    CHECK_THROWS(session.apply(EditForgetVolume{kLearner, 0}));  // nothing learned yet
    render_passes(session, 1);
    CHECK_THROWS(session.apply(EditForgetVolume{kLearner, 100000}));
    CHECK_THROWS(session.apply(EditForgetVolume{MethodId::Precomputed, 0}));
    CHECK_THROWS(session.apply(EditLearning{MethodId::Default, LearningControl::Freeze}));
    session.apply(EditForget{});
    CHECK_FALSE(session.field_status(kLearner)->was_edited);
}

// A field frozen early is worse, not wrong: the picture has the mean of default's by rule S2. 40 x 40 pixels, 64 batches of 8 passes,
// seed 3; a relative difference of 3 % would be seen with probability 0.999.
TEST_CASE("a picture by a frozen field converges to that of default") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = quick_learner(scene, {kLearner, true}, 40, 3);
    settings.learn_passes = 2;
    Session frozen = make_session(scene, settings, 2);
    Session plain = make_session(scene, settings_for(scene, {MethodId::Default, true}, 40, 40), 2);
    Picture a(40, 40);
    Picture b(40, 40);
    render_batches(frozen, a, 64, 8);
    render_batches(plain, b, 64, 8);
    CHECK(same_picture(a, b, 0.03));
}

TEST_CASE("a learner is asked at every update, and keeps the bits where it returns the table's own radiance") {
    Session own = learner();
    Session asked = learner();
    std::uint32_t questions = 0;
    asked.set_learner([&](const LearnerInput& input) {
        ++questions;
        HostTables tables = input.tables;
        const TableUpdateView field = update_view(input.shape, tables);
        for (std::uint32_t cell = 0; cell < tables.radiance.size(); ++cell) absorb_samples(field, cell);
        return LearnedCells{.are_radiance = true, .values = {tables.radiance.begin(), tables.radiance.end()}};
    });
    for (int pass = 0; pass < 20; ++pass) {  // beyond the first refinement
        render_passes(own, 1);
        render_passes(asked, 1);
        REQUIRE(same_state(state_of(own), state_of(asked)));
    }
    CHECK(questions >= 8);
}

TEST_CASE("a learner that fails is told of after a whole pass, and the table's own probabilities stand") {
    Session own = learner();
    Session asked = learner();
    asked.set_learner([](const LearnerInput& input) {
        return LearnedCells{.values = std::vector<float>(input.tables.radiance.size(), -1.0f)};
    });
    for (std::uint32_t pass = 1; pass <= 3; ++pass) {
        render_passes(own, 1);
        CHECK(input_error([&] {
                  asked.advance(slot_of(asked));
              }).starts_with("learner, probabilities of volume 0, cell 0"));
        CHECK(asked.passes(slot_of(asked)) == pass);
        CHECK(same_state(state_of(own), state_of(asked)));
    }
    asked.set_learner([](const LearnerInput&) -> LearnedCells { throw std::out_of_range("of its own"); });
    CHECK_THROWS_AS(asked.advance(slot_of(asked)), std::out_of_range);
    asked.set_learner({});
    render_passes(asked, 1);
    render_passes(own, 2);
    CHECK(same_state(state_of(own), state_of(asked)));
}

TEST_CASE("a learner is for tables") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, kLearningPaths);
    settings.field.representation = Representation::SdTree;
    Session session = make_session(scene, settings);
    CHECK(error_message(ErrorKind::Usage, [&] {
              session.set_learner([](const LearnerInput&) { return LearnedCells{}; });
          }) == "a learner fills tables: expected --field table with it, got --field sd-tree");
}
