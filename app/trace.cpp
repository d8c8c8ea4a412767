// `pathlight trace`: one path of a picture, every vertex with its densities and weights.
#include "app/commands.h"
#include "app/field_files.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/run_passes.h"
#include "app/trace_report.h"
#include "core/diagnose/record_path.h"

namespace pl {
namespace {

/// Passes that change the path of a later one: those by which the field learns or guidance is chosen.
std::uint32_t passes_before(const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const bool chooses = options.render.guiding == GuidingRule::Paying && options.render.next_event;
    return method.learns || (method.uses_field && chooses) ? *options.sample : 0;
}

/// Brings the session to the path. Returns false if it was interrupted.
bool come_to_path(Session& session, const Options& options, std::uint32_t pixel, const InterruptGuard& interrupt,
                  Console& console) {
    Options limits = options;
    limits.spp = passes_before(options);
    limits.time_limit_seconds.reset();
    if (*limits.spp > 0 && run_passes(session, limits, interrupt, console).interrupted()) return false;
    Progress progress = Progress::Precomputed;
    while (progress == Progress::Precomputed && !interrupt.raised())
        progress = session.advance_to_path(slot_of(options.render), pixel, interrupt.flag());
    return progress == Progress::Rendered;
}

}  // namespace

int run_trace(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    require_pixel_inside(options);
    Session session(make_backend(options.backend, options.threads), loaded.scene, options.render,
                    loaded.load_seconds + fields.load_seconds());
    fields.hand_over(session, options, console);

    const auto pixel = static_cast<std::uint32_t>(options.pixel->y * options.render.width + options.pixel->x);
    if (!come_to_path(session, options, pixel, interrupt, console)) {
        console.log().warning("interrupted: no path is traced");
        return kExitInterrupted;
    }
    PassReplay passes = session.pass_replay(slot_of(options.render));
    const AnyFieldView field = field_of(passes);
    const PathRecord path = record_path(passes, field, pixel, *options.sample);
    const TracedPath traced{path, *loaded.scene, options.render, *options.sample};
    if (console.json())
        console.event("path", path_json(traced));
    else
        console.result(path_text(traced));
    return 0;
}

}  // namespace pl
