// The fields of a session without its films: what is made when, which passes train, and what an edit leaves.
#include "core/session/session_fields.h"

#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr MethodId kMap = MethodId::Precomputed;

/// Inputs with the fields of a session on them.
struct Fields {
    RenderInputs inputs;
    SessionFields fields{inputs};

    Fields() : inputs{.backend = make_cpu_backend({.threads = 1}), .settings = {}, .scene = SessionScene(door())} {
        inputs.settings = small_settings(*inputs.scene.description(), {kLearner, false});
        inputs.backend->upload_scene(inputs.scene.packed());
    }
    Fields(const Fields&) = delete;
    Fields& operator=(const Fields&) = delete;

    static std::shared_ptr<const SceneDescription> door() {
        return std::make_shared<const SceneDescription>(shipped_scene("door"));
    }

    /// A learner after some passes without paths.
    void pass(int passes = 1) {
        fields.ensure_field(kLearner);
        for (int i = 0; i < passes; ++i) {
            fields.begin_pass(kLearner);
            fields.finish_pass(kLearner, true, false);
        }
    }
    void control(LearningControl control, bool is_under_way = false, bool trains = true) {
        inputs.settings.learn_passes = fields.control_learning({kLearner, control}, is_under_way, trains);
    }
    void precompute(bool is_coarse) { REQUIRE(fields.precompute({kMap, View::Beauty}, is_coarse, nullptr)); }
};

}  // namespace

TEST_CASE("Session fields: volumes are placed and fields made when a method needs them, and cleared apart") {
    Fields made;
    SessionFields& fields = made.fields;
    CHECK_FALSE(fields.status(kLearner));
    fields.ensure_volumes();
    REQUIRE(fields.placement().is_placed());
    CHECK_FALSE(made.inputs.backend->has_field(kLearner));
    fields.ensure_field(MethodId::Default);  // its views show the field of the learner
    CHECK(made.inputs.backend->has_field(kLearner));
    CHECK_FALSE(made.inputs.backend->has_field(kMap));
    CHECK(fields.status(kLearner)->volumes == static_cast<int>(fields.placement().count()));
    CHECK_FALSE(fields.status(MethodId::Default));
    fields.clear_tables();
    CHECK(fields.placement().is_placed());
    CHECK_FALSE(made.inputs.backend->has_field(kLearner));
    fields.clear_volumes();
    CHECK_FALSE(fields.placement().is_placed());
}

TEST_CASE("Session fields: passes are counted, and a frozen field is updated by its last pass") {
    Fields made;
    SessionFields& fields = made.fields;
    CHECK_FALSE(fields.is_warm(kLearner));
    made.pass(3);
    CHECK(fields.is_warm(kLearner));
    CHECK(fields.trained_passes(kLearner) == 3);
    CHECK(fields.progress(kLearner).updates == 0);  // none was due
    made.inputs.settings.learn_passes = 4;
    CHECK(fields.is_trained_by_pass(kLearner, 3));
    made.pass();
    CHECK(fields.progress(kLearner).updates == 1);
    CHECK(fields.is_frozen(kLearner));
    CHECK_FALSE(fields.is_trained_by_pass(kLearner, 4));
    fields.finish_pass(kLearner, false, true);
    CHECK(fields.trained_passes(kLearner) == 4);
    CHECK(fields.progress(kLearner).passes == 5);
    CHECK(fields.progress(kLearner).updates == 1);
}

TEST_CASE("Session fields: a pass that was left within its parts is skipped, for its random numbers") {
    Fields made;
    made.fields.ensure_field(kLearner);
    made.fields.begin_pass(kLearner);
    made.fields.update_within_pass(kLearner);
    CHECK(made.fields.is_warm(kLearner));
    CHECK(made.fields.progress(kLearner).passes == 0);
    made.fields.begin_pass(kLearner);
    CHECK(made.fields.progress(kLearner).passes == 1);
    CHECK_FALSE(made.fields.progress(kLearner).has_part);
}

TEST_CASE("Session fields: learning is frozen behind the pass under way, stepped and continued") {
    Fields made;
    made.pass(2);
    made.control(LearningControl::Freeze);
    CHECK(made.inputs.settings.learn_passes == 2);
    CHECK(made.fields.progress(kLearner).updates == 1);  // by the samples that were pending
    CHECK_FALSE(made.fields.progress(kLearner).was_edited);
    made.control(LearningControl::Step);
    CHECK(made.inputs.settings.learn_passes == 3);
    CHECK(made.fields.progress(kLearner).was_edited);
    made.control(LearningControl::Freeze, true, true);
    CHECK(made.inputs.settings.learn_passes == 3);
    made.control(LearningControl::Freeze, true, false);
    CHECK(made.inputs.settings.learn_passes == 2);
    made.control(LearningControl::Continue);
    CHECK(made.inputs.settings.learn_passes == kEveryPass);
    CHECK_THAT(error_message(ErrorKind::Usage,
                             [&] {
                                 made.fields.control_learning({kMap, LearningControl::Freeze}, false, false);
                             }),
               contains("nothing to freeze"));
}

TEST_CASE("Session fields: a volume is forgotten at once, or before the next pass if one is under way") {
    Fields made;
    const auto forget = [&](std::int32_t volume, bool is_under_way) {
        made.fields.forget_volume({kLearner, volume}, is_under_way);
    };
    CHECK_THAT(error_message(ErrorKind::Usage, [&] { forget(0, false); }), contains("has learned nothing"));
    made.pass();
    CHECK_FALSE(made.fields.is_update_due(kLearner, 80));
    forget(5, true);
    CHECK(made.fields.progress(kLearner).forgotten == std::vector<std::int32_t>{5});
    CHECK(made.fields.is_update_due(kLearner, 80));  // soon, however many passes the film has
    made.pass();
    CHECK(made.fields.progress(kLearner).forgotten.empty());
    forget(6, false);
    CHECK(made.fields.progress(kLearner).forgotten.empty());
    CHECK(made.fields.progress(kLearner).updates == 2);
    CHECK_THAT(error_message(ErrorKind::Usage, [&] { forget(100'000, false); }), contains("does not exist"));
}

TEST_CASE("Session fields: a map is coarse first, then filled slice by slice") {
    Fields made;
    SessionFields& fields = made.fields;
    fields.ensure_field(kMap);
    CHECK_FALSE(fields.has_coarse_map(kMap));
    made.precompute(true);
    CHECK(fields.has_coarse_map(kMap));
    CHECK_FALSE(fields.is_map_complete(kMap));
    CHECK(fields.status(kMap)->precomputed_share == 0.25 / 4);
    for (int slice = 0; slice < 4; ++slice) made.precompute(false);
    CHECK(fields.is_map_complete(kMap));
    CHECK(fields.status(kMap)->precomputed_share == 1.0);
    CHECK(fields.progress(kMap).updates == 2);  // of the coarse map, and of the complete one
}

TEST_CASE("Session fields: what was learned moves through files, states and to another back end") {
    Fields from;
    from.fields.ensure_field(kMap);
    from.precompute(false);
    const HostTables learned = tables_of(from.fields.export_field(kMap).field);

    Fields by_file;
    by_file.fields.import_field(from.fields.export_field(kMap));
    CHECK(same_bits(tables_of(by_file.fields.export_field(kMap).field), learned));
    CHECK(by_file.fields.progress(kMap).precomputed_slices == 1);

    Fields by_state;
    SessionState state{.identity = {}, .placement = {}, .fields = {}, .films = {}, .is_closed = {}};
    from.fields.save_state(state);
    by_state.fields.restore_state(state);
    CHECK(same_bits(tables_of(by_state.fields.export_field(kMap).field), learned));
    CHECK(by_state.fields.progress(kMap) == from.fields.progress(kMap));
    CHECK(by_state.fields.state_bytes() == from.fields.state_bytes());

    const std::shared_ptr<RenderBackend> other = make_cpu_backend({.threads = 1});
    other->upload_scene(from.inputs.scene.packed());
    from.fields.upload(*other, from.fields.download());
    CHECK(same_bits(tables_of(other->download_field(kMap)), learned));
}
