// `pathlight render`: a picture without a display.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/picture_target.h"
#include "app/run_passes.h"
#include "app/state_files.h"
#include "app/stats_json.h"
#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/picture_file.h"
#include "core/session/shown_range.h"

namespace pl {
namespace {

void require_outputs(const Options& options, Console& console) {
    require_target(options.output, console);
    if (!options.stats_file.empty()) require_writable(options.stats_file);
    if (!options.save_field.empty()) require_writable(options.save_field);
    if (!options.checkpoint_file.empty()) require_writable(options.checkpoint_file);
}

/// ", noise 0.0098 (target 0.01)"; empty without a target.
std::string target_text(const ErrorTarget* target) {
    if (target == nullptr) return "";
    return fmt::format(", noise {} (target {:.3g})",
                       target->measured() ? fmt::format("{:.3g}", *target->measured()) : "unknown", target->target());
}

/// Throws Error(Threshold) if another limit ended the rendering before the target was met.
void require_low_error(ErrorTarget* target, const RunOutcome& outcome) {
    if (target == nullptr || target->is_low_enough()) return;
    throw Error(ErrorKind::Threshold,
                fmt::format("--target-error: expected noise of at most {:.3g} as relMSE, got {} when {} was reached",
                            target->target(),
                            target->measured() ? fmt::format("{:.3g}", *target->measured()) : "none that is known",
                            label_of(outcome.ended_by)));
}

void report(const Snapshot& snapshot, const Options& options, const Json& stats, bool interrupted,
            const ErrorTarget* target, const CheckpointFiles& checkpoints, Console& console) {
    const double seconds = snapshot.clocks.total();
    const std::string range = picture_kind(options.output) == ImageKind::Png ? legend(snapshot) : "";
    console.remark(fmt::format("{}: {}x{}, {}, {}, {} spp, {:.2f} s{}{}{}{}\n", options.output, snapshot.width,
                               snapshot.height, info_of(snapshot.slot.method).name, info_of(snapshot.slot.view).name,
                               snapshot.passes, seconds, target_text(target), range.empty() ? "" : ", range ", range,
                               interrupted ? ", partial" : ""));
    console.event("done", {{"output", options.output},
                           {"run", 1},
                           {"spp", snapshot.passes},
                           {"t_render", snapshot.clocks.render},
                           {"interrupted", interrupted},
                           {"stats", stats}});
    if (interrupted)
        console.log().warning(picture_kind(options.output) == ImageKind::Pfm
                                  ? "interrupted: the picture is partial, and a .pfm file cannot be marked so"
                                  : "interrupted: the picture is partial and marked so");
    if (const std::string way_on = checkpoints.way_on(); interrupted && !way_on.empty()) console.log().notice(way_on);
    if (snapshot.counters.invalid_samples > 0)
        console.log().warning(
            fmt::format("{} samples were NaN, infinite or negative and left out", snapshot.counters.invalid_samples));
    if (snapshot.is_closed && snapshot.counters.path.escaped > 0)
        console.log().warning(fmt::format("{} paths escaped although closed surfaces surround the camera",
                                          snapshot.counters.path.escaped));
    if (snapshot.field && snapshot.field->network && snapshot.field->network->is_lost)
        console.log().warning("the network of the field was not finite: paths are guided by the cosine");
}

/// run_passes() with a last checkpoint. An error on the way, such as a rank that has died, names the checkpoint to go on from.
RunOutcome run_saved(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console,
                     const RunAids& aids) {
    try {
        const RunOutcome outcome = run_passes(session, options, *interrupt.flag(), console, Until::Rendered, aids);
        aids.checkpoints->save(session, outcome.seconds);
        return outcome;
    } catch (const Error& error) {
        const std::string way_on = aids.checkpoints->way_on();
        if (way_on.empty()) throw;
        throw Error(error.kind(), fmt::format("{}; {}", error.what(), way_on));
    }
}

}  // namespace

int run_render(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    require_outputs(line.options, console);
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    CheckpointFiles checkpoints(line.options, console);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    Session session(make_backend(options.backend, options.threads), loaded.scene, options.render,
                    loaded.load_seconds + fields.load_seconds());
    fields.hand_over(session, options, console);
    checkpoints.hand_over(session);
    announce(session, console);
    const std::string command = command_text(Command::Render, options, scene_defaults(options.scene, *loaded.scene));
    const FilmSlot slot = slot_of(options.render);

    std::optional<ErrorTarget> target;
    if (options.target_error) target.emplace(*options.target_error);
    ErrorTarget* const aim = target ? &*target : nullptr;
    const RunOutcome outcome = run_saved(session, options, interrupt, console, {aim, &checkpoints});
    if (aim != nullptr) aim->measure_last(session, slot);
    const Snapshot snapshot = session.snapshot(slot);
    const Json stats = stats_json(session, snapshot, options, outcome, aim);
    const ImageMetadata metadata = metadata_of(session, snapshot, stats, command, outcome.interrupted());
    write_picture(options.output, snapshot, options.display, metadata, console);
    if (!options.stats_file.empty()) write_file_atomic(options.stats_file, stats.dump(2) + "\n");
    fields.save(session, options, console);
    report(snapshot, options, stats, outcome.interrupted(), aim, checkpoints, console);
    if (outcome.interrupted()) return kExitInterrupted;
    require_low_error(aim, outcome);
    return 0;
}

}  // namespace pl
