// `pathlight trace`: one path of a picture, every vertex with its densities and weights; several of one pixel; its noise; or what is wrong
// with the whole picture, and where it gains.
#include "app/commands.h"
#include "app/diagnostics_file.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/noise_report.h"
#include "app/open_scene.h"
#include "app/picture_target.h"
#include "app/run_passes.h"
#include "app/scene_picture.h"
#include "app/state_files.h"
#include "app/stats_json.h"
#include "app/trace_report.h"
#include "core/base/error.h"
#include "core/diagnose/pixel_paths.h"
#include "core/diagnose/record_path.h"
#include "core/io/files.h"
#include "core/io/picture_file.h"

namespace pl {
namespace {

/// Passes that change the path of a later one: those by which the field learns or guidance is chosen.
std::uint32_t passes_before(std::uint32_t sample, const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const bool chooses = options.render.guiding == GuidingRule::Paying && options.render.next_event;
    return method.learns || (method.uses_field && chooses) ? sample : 0;
}

std::uint32_t pixel_of(const Options& options) {
    return static_cast<std::uint32_t>(options.pixel->y * options.render.width + options.pixel->x);
}

/// Brings the session to the path of a sample. Returns false if it was interrupted.
bool come_to_path(Session& session, std::uint32_t sample, const Options& options, const InterruptGuard& interrupt,
                  Console& console) {
    Options limits = options;
    limits.spp = passes_before(sample, options);
    limits.time_limit_seconds.reset();
    if (*limits.spp > 0 && run_passes(session, limits, *interrupt.flag(), console).interrupted()) return false;
    Progress progress = Progress::Precomputed;
    while (progress == Progress::Precomputed && !interrupt.raised())
        progress = session.advance_to_path(slot_of(options.render), pixel_of(options), interrupt.flag());
    return progress == Progress::Rendered;
}

/// The paths of all samples, each with the field that its pass samples from. Empty if they were interrupted.
std::vector<diagnose::PathRecord> trace_samples(Session& session, const Options& options,
                                                const InterruptGuard& interrupt, Console& console) {
    std::vector<diagnose::PathRecord> paths;
    for (std::uint32_t sample = options.samples->first; sample <= options.samples->last; ++sample) {
        if (!come_to_path(session, sample, options, interrupt, console)) return {};
        PassReplay passes = session.pass_replay(slot_of(options.render));
        paths.push_back(diagnose::record_path(passes, diagnose::field_of(passes), pixel_of(options), sample));
    }
    return paths;
}

/// Before any work is done for them.
void require_trace_outputs(const Options& options) {
    if (!options.diagnostics_file.empty()) {
        image_kind(options.diagnostics_file);
        require_writable(options.diagnostics_file);
    }
    if (options.output.empty()) return;
    require_viewer_code("-o");
    if (image_kind(options.output) != ImageKind::Png)
        throw Error(ErrorKind::Usage, options.output + ": lines are drawn into a .png");
    require_writable(options.output);
}

/// Renders the whole picture, then writes where something is wrong in it, and where it gains. Returns the exit code.
int trace_picture(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console) {
    const RunOutcome outcome = run_passes(session, options, *interrupt.flag(), console);
    const Snapshot snapshot = session.snapshot(slot_of(options.render));
    bool is_complete = !outcome.interrupted();
    if (!options.diagnostics_file.empty()) {
        const std::string command =
            command_text(Command::Render, options, scene_defaults(options.scene, session.scene()));
        is_complete &=
            write_diagnostics(session, snapshot, options,
                              metadata_of(session, snapshot, stats_json(session, snapshot, options, outcome), command,
                                          outcome.interrupted()),
                              interrupt, console);
    }
    if (is_complete && !options.gain_file.empty()) is_complete = write_gain(session, options, interrupt, console);
    return is_complete ? 0 : kExitInterrupted;
}

}  // namespace

int run_trace(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    require_trace_outputs(line.options);
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    require_pixel_inside(options);
    require_gain(options);
    RenderSettings settings = options.render;
    if (options.why)
        settings.guiding = GuidingRule::Always;  // the field is wanted, not the picture: every pass trains it
    Session session(make_backend(options.backend, options.threads), loaded.scene, settings,
                    loaded.load_seconds + fields.load_seconds());
    fields.hand_over(session, options, console);
    if (options.why) return trace_noise(session, options, interrupt, console);
    if (!options.pixel) return trace_picture(session, options, interrupt, console);

    const std::vector<diagnose::PathRecord> paths = trace_samples(session, options, interrupt, console);
    if (paths.empty()) {
        console.log().warning("interrupted: no path is traced");
        return kExitInterrupted;
    }
    for (const std::size_t i : diagnose::by_light(paths)) {
        const TracedPath traced{paths[i], *loaded.scene, options.render,
                                options.samples->first + static_cast<std::uint32_t>(i)};
        if (console.json())
            console.event("path", path_json(traced));
        else
            console.result(paths.size() == 1 ? path_text(traced) : path_line(traced));
    }
    if (!options.output.empty()) write_png8(options.output, draw_path_lines(session, paths, options));
    return 0;
}

}  // namespace pl
