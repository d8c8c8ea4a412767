// `pathlight inspect`: trains, then writes the learned hemisphere at a point.
#include <algorithm>

#include <fmt/format.h>

#include "app/closest_surface.h"
#include "app/commands.h"
#include "app/inspection_file.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/parse_values.h"
#include "app/run_passes.h"
#include "app/scene_picture.h"
#include "app/state_files.h"
#include "app/stats_json.h"
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/files.h"
#include "core/io/picture_file.h"
#include "core/session/path_settings.h"

namespace pl {
namespace {

void require_outputs(const Options& options) {
    const InspectionKind kind = inspection_kind(options.output);
    if (options.history) require_viewer_code("--history");
    if (kind == InspectionKind::AsPng) require_viewer_code(options.output);
    if (options.drawn != HemisphereDisplay::Disc && (kind != InspectionKind::AsPng || options.history))
        throw Error(ErrorKind::Usage, fmt::format("{}: --drawn {} is a picture of cells: expected a .png and no "
                                                  "--history",
                                                  options.output, name_of(options.drawn)));
    require_writable(options.output);
    if (!options.stats_file.empty()) require_writable(options.stats_file);
    if (!options.save_field.empty()) require_writable(options.save_field);
}

[[noreturn]] void fail_nothing(const std::string& where) {
    throw Error(ErrorKind::Runtime,
                fmt::format("no radiance volume serves {}: volumes stand on surfaces that reflect", where));
}

std::int32_t volume_at(Session& session, const ScenePoint& point) {
    if (point.normal) {
        const std::int32_t volume = session.find_volume_at(point.position, *point.normal);
        if (volume == kNoVolume)
            fail_nothing(fmt::format("the point {} with normal {}", print_vector(point.position),
                                     print_vector(*point.normal)));
        return volume;
    }
    const ClosestSurface surface = closest_surface(session.scene(), point.position);
    std::int32_t volume = session.find_volume_at(surface.position, surface.normal);
    if (volume == kNoVolume) volume = session.find_volume_at(surface.position, -surface.normal);
    if (volume == kNoVolume) fail_nothing(fmt::format("the surface closest to {}", print_vector(point.position)));
    return volume;
}

std::int32_t volume_under(Session& session, const glm::ivec2& pixel) {
    const std::optional<PickedPoint> picked = session.pick(Vec2f(pixel) + 0.5f);
    if (!picked)
        throw Error(ErrorKind::Runtime, fmt::format("--pixel {},{}: nothing is seen there", pixel.x, pixel.y));
    if (picked->volume == kNoVolume) fail_nothing(fmt::format("the surface at pixel {},{}", pixel.x, pixel.y));
    return picked->volume;
}

/// A loaded field is inspected as it is, unless limits ask for more training. A radiance map is completed in any
/// case.
bool is_trained(const Options& options) {
    return !options.load_field.empty() && info_of(options.render.method).learns && !options.spp &&
           !options.time_limit_seconds;
}

/// The light that reaches the volume; without figures if it was interrupted before it had any.
LightGatherer trace_light(const Session& session, const VolumeInspection& volume, const Options& options,
                          const InterruptGuard& interrupt) {
    LightGatherer gatherer(session.packed_scene(), LightReceiver::of(volume, options.render.camera.eye),
                           path_settings(options.render, baseline_method()));
    for (std::uint32_t i = 0; i < options.truth_samples && gatherer.advance(interrupt.flag()); ++i) {
    }
    return gatherer;
}

/// Trains as run_passes() does; with --history in pieces, as long as the key frames are apart, and observed by `past`.
RunOutcome train(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console,
                 FieldPast& past) {
    if (!options.history) return run_passes(session, options, *interrupt.flag(), console, Until::Learned);
    const FilmSlot slot = slot_of(options.render);
    Options piece = options;
    RunOutcome outcome;
    for (std::uint32_t passes = 1; !outcome.interrupted(); passes = FieldPast::next(passes)) {
        piece.spp = std::min(passes, options.spp_limit());
        outcome = run_passes(session, piece, *interrupt.flag(), console, Until::Learned);
        past.observe(session, slot.method);
        if (session.passes(slot) >= options.spp_limit() || outcome.ended_by != EndedBy::Spp) break;
    }
    return outcome;
}

void report_truth(const LightReport& truth, double seconds, Console& console) {
    for (const std::string& line : truth_lines(truth)) console.remark(line + "\n");
    console.event("truth", {{"paths_per_cell", truth.paths_per_cell},
                            {"seconds", seconds},
                            {"table_divergence", truth.figures.table.value},
                            {"mixture_divergence", truth.figures.mixture.value}});
}

void report(const VolumeInspection& volume, const Options& options, bool interrupted, Console& console) {
    console.remark(fmt::format("{}: volume {} at {}, normal {}, mean radiance {}{}\n", options.output, volume.volume,
                               print_vector(volume.position), print_vector(volume.normal),
                               print_float(volume.mean_radiance), interrupted ? ", partial" : ""));
    console.event("done", {{"output", options.output},
                           {"volume", volume.volume},
                           {"mean_radiance", volume.mean_radiance},
                           {"interrupted", interrupted}});
}

}  // namespace

int run_inspect(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    require_outputs(line.options);
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    require_pixel_inside(options);
    RenderSettings training = options.render;
    training.guiding = GuidingRule::Always;  // the field is wanted, not the picture: every pass trains it
    Session session(make_backend(options.backend, options.threads), loaded.scene, training,
                    loaded.load_seconds + fields.load_seconds());
    fields.hand_over(session, options, console);
    // Before training, so that a place without a volume fails at once.
    const std::int32_t index = options.at ? volume_at(session, *options.at) : volume_under(session, *options.pixel);

    FieldPast past;
    const RunOutcome outcome = is_trained(options) ? RunOutcome{} : train(session, options, interrupt, console, past);
    const FilmSlot slot = slot_of(options.render);
    const VolumeInspection volume = session.inspect_volume(slot.method, index);
    std::optional<LightReport> truth;
    std::vector<HistoryPoint> history;
    if (options.truth || options.history) {
        const Stopwatch watch;
        const LightGatherer gatherer = trace_light(session, volume, options, interrupt);
        const TargetLight target = target_light(session.settings(), options.render.method);
        if (gatherer.light().has_all_groups()) {
            truth = report_light(gatherer.light(), volume, target);
            history = past.points(gatherer.light(), index, target);
            report_truth(*truth, watch.seconds(), console);
        }
    }
    const bool interrupted = outcome.interrupted() || interrupt.raised();
    if (options.history && history.empty())
        throw Error(ErrorKind::Runtime, "--history: no pass has trained the field, so that there is no key frame");
    const InspectionSource source{.scene = options.scene,
                                  .scene_hash = session.scene_hash(),
                                  .method = std::string(info_of(options.render.method).name),
                                  .spp = session.passes(slot),
                                  .seed = options.render.seed,
                                  .partial = interrupted,
                                  .camera = options.render.camera,
                                  .truth = std::move(truth)};
    if (options.history)
        save_history(options.output, history, volume, source);
    else if (options.drawn != HemisphereDisplay::Disc)
        write_png8(options.output, draw_in_scene(session, index, options));
    else
        save_inspection(options.output, volume, source);
    if (!options.stats_file.empty())
        write_file_atomic(options.stats_file,
                          stats_json(session, session.snapshot(slot), options, outcome).dump(2) + "\n");
    fields.save(session, options, console);
    report(volume, options, interrupted, console);
    return interrupted ? kExitInterrupted : 0;
}

}  // namespace pl
