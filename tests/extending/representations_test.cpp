// Every line of the list of representations (core/fields/field_model.h) is known on each floor: the command line, the help, the lists of
// the window, the session, field files, checkpoints and inspection. No floor has a list of its own that this test could forget.
#include <set>

#include "core/fields/field_choices.h"
#include "core/fields/field_kernels.h"
#include "core/io/checkpoint_file.h"
#include "tests/app/parsing.h"
#include "tests/core/session/through_file.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

#include "app/option_table.h"

using namespace pl;
using namespace pl::test;

namespace {

/// The settings of a small picture by `pathlight render --method reinforcement --field NAME`.
RenderSettings settings_by_command(const SceneDescription& scene, std::string_view name) {
    const Options options =
        parse({"render", "cornell", "-o", "x.png", "--method", "reinforcement", "--field", std::string(name)});
    RenderSettings settings = small_settings(scene, {options.render.method, true});
    settings.field.representation = options.render.field.representation;
    return settings;
}

/// Sums over all cells of a volume.
struct Seen {
    double probability = 0.0, radiance = 0.0;
};
Seen seen_in(const VolumeInspection& volume) {
    Seen seen;
    for (const float share : volume.probability) seen.probability += static_cast<double>(share);
    for (const float radiance : volume.radiance) seen.radiance += static_cast<double>(radiance);
    return seen;
}

}  // namespace

TEST_CASE("Every representation is chosen by its name, on the command line and in lists") {
    const auto& specs = option_table();
    const auto spec = std::ranges::find(specs, "field", &OptionSpec::name);
    REQUIRE(spec != specs.end());
    std::set<Representation> values;
    for (const ChoiceInfo<Representation>& info : kRepresentations) {
        CAPTURE(std::string(info.name));
        CHECK(values.insert(info.value).second);
        CHECK(choice_named<Representation>(info.name) == info.value);
        CHECK(label_of(info.value) == info.label);
        CHECK_THAT(spec->help_text(), contains(std::string(info.name)));
        const Options options =
            parse({"render", "s", "-o", "x.png", "--method", "reinforcement", "--field", std::string(info.name)});
        CHECK(options.render.field.representation == info.value);
        CHECK(options.backend == (is_for_devices(info.value) ? "auto" : "cpu"));
    }
    CHECK(kChoices<Representation>.size() == kRepresentations.size());
}

TEST_CASE("Every representation has kernels on the host, for Expected Sarsa at least, and a cost") {
    for (const ChoiceInfo<Representation>& info : kRepresentations) {
        CAPTURE(std::string(info.name));
        CHECK(has_target(info.value, LearningTarget::ExpectedSarsa));
        CHECK(guidance_of(info.value) >= 1.0);
        const HostField field = make_field({.cells = {4}}, 3, info.value);
        CHECK(representation_of(field) == info.value);
        CHECK(fits({.cells = {4}}, field, 3));
        CHECK_FALSE(fits({.cells = {4}}, field, 4));
        CHECK(field_bytes(field) > 0);
        CHECK_FALSE(text_of({.cells = {4}}, field).empty());
    }
}

TEST_CASE(
    "A field of every representation goes from the command line through session, inspection, files and checkpoints") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const ChoiceInfo<Representation>& info : kRepresentations) {
        CAPTURE(std::string(info.name));
        Session session = make_session(scene, settings_by_command(scene, info.name), 2);
        render_passes(session, 3);
        const FieldStatus status = *session.field_status(MethodId::Reinforcement);
        CHECK(status.representation == info.value);
        CHECK(status.bytes > 0);

        double lit = 0.0;
        for (std::int32_t volume = 0; volume < status.volumes; ++volume) {
            const Seen seen = seen_in(session.inspect_volume(MethodId::Reinforcement, volume));
            CHECK((seen.probability >= 0.0 && seen.probability < 1.5));
            lit += seen.radiance;
        }
        CHECK(lit > 0.0);

        const LearnedField learned = session.export_field(MethodId::Reinforcement);
        CHECK_THAT(summary_of(learned), contains(text_of(learned.shape, learned.field)));
        const LearnedField read = through_file(learned);
        CHECK(representation_of(read.field) == info.value);
        CHECK(same_bits(read.field, learned.field));

        const TemporaryFolder folder;
        write_checkpoint(folder.path() / "c", {.seconds = 0.0, .state = session.save_state()});
        Session next = make_session(scene, settings_by_command(scene, info.name), 1);
        next.restore_state(read_checkpoint(folder.path() / "c").state);
        CHECK(same_state(state_of(next), state_of(session)));

        session.apply(EditForgetVolume{MethodId::Reinforcement, 3});
        CHECK(session.inspect_volume(MethodId::Reinforcement, 3).mean_radiance == 0.0f);
    }
}
