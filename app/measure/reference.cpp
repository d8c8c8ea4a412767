// `pathlight reference`: a converged picture in two independent halves.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/progress.h"
#include "core/bench/reference_store.h"

namespace pl {

int run_reference(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    const Options options = resolve_options(line, *loaded.scene);
    Session session(make_backend(options.backend, options.threads), loaded.scene, options.render,
                    loaded.load_seconds);
    const bench::ReferenceStore store(options.output);
    ProgressDisplay progress(console, !options.no_progress && !options.quiet);
    const bench::ReferenceOutcome outcome =
        bench::make_reference(session,
                              {.scene = options.scene,
                               .spp = options.spp_limit(),
                               .seconds = options.time_limit_seconds,
                               .stop = interrupt.flag(),
                               .show = [&](const ProgressState& state) { progress.show(state); }},
                              store);
    progress.clear();

    const auto& [first, second] = outcome.reference.halves;
    const Noise noise = outcome.reference.noise();
    console.remark(fmt::format("{}: {}x{}, {} + {} spp, noise as relMSE {:.3g}{}\n", outcome.manifest.string(),
                               options.render.width, options.render.height, first.spp, second.spp, noise.relmse,
                               outcome.interrupted ? ", unfinished" : ""));
    console.event("done", {{"output", outcome.manifest.string()},
                           {"picture_hash", outcome.reference.content.picture_hash},
                           {"spp", Json::array({first.spp, second.spp})},
                           {"noise_relmse", noise.relmse},
                           {"interrupted", outcome.interrupted}});
    if (noise.invalid > 0)
        console.log().warning(
            fmt::format("{} pixels are NaN or infinite: pictures are not scored there", noise.invalid));
    if (outcome.interrupted) {
        console.log().warning("interrupted: the same command continues from here");
        return kExitInterrupted;
    }
    return 0;
}

}  // namespace pl
