#include "app/noise_report.h"

#include <cmath>

#include <fmt/format.h>

#include "app/run_passes.h"
#include "app/scene_picture.h"
#include "core/base/error.h"
#include "core/bench/bench_results.h"
#include "core/io/files.h"
#include "core/io/picture_file.h"
#include "core/measure/run_recorder.h"
#include "core/session/methods.h"

namespace pl {
namespace {

std::string bounds_text(const Interval& value) {
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", value.value, value.low, value.high);
}

/// "  light samples    97.1 % (95.2 to 99.0)"; empty for a part without contributions.
std::string share_line(std::string_view name, const Interval& share) {
    if (share.value == 0.0 && share.low == 0.0 && share.high == 0.0) return "";
    return fmt::format("  {:<16} {:6.1f} % ({:.1f} to {:.1f})\n", name, 100.0 * share.value, 100.0 * share.low,
                       100.0 * share.high);
}

std::string shares_text(const diagnose::NoiseShares& shares) {
    std::string text = "  noise by technique\n";
    for (const ChoiceInfo<diagnose::Technique>& info : kChoices<diagnose::Technique>)
        text += share_line(info.label, shares.found_by[static_cast<std::size_t>(info.value)]);
    text += "  noise by bounces\n";
    for (std::size_t i = 0; i < diagnose::kBounceClasses; ++i)
        text += share_line(diagnose::bounce_name(i), shares.bounces[i]);
    text += "  noise by light\n";
    for (std::size_t i = 0; i < shares.lights.size(); ++i)
        text += share_line(diagnose::kNoiseLights[i], shares.lights[i]);
    return text;
}

std::string estimate_text(std::string_view method, const diagnose::PixelEstimate& estimate) {
    std::string text =
        fmt::format("{}: luminance {}, variance of a path {}, {:.3g} us a path\n", method, bounds_text(estimate.mean),
                    bounds_text(estimate.variance), 1.0e6 * estimate.seconds_per_path);
    return text + (estimate.shares ? shares_text(*estimate.shares) : "  no noise\n");
}

Json estimate_json(std::string_view method, const diagnose::PixelEstimate& estimate) {
    Json json{{"method", method},
              {"paths", estimate.paths},
              {"luminance", bench::interval_json(estimate.mean)},
              {"variance", bench::interval_json(estimate.variance)},
              {"seconds_per_path", estimate.seconds_per_path},
              {"by_technique", Json()},
              {"by_bounces", Json()},
              {"by_light", Json()}};
    if (!estimate.shares) return json;
    for (const ChoiceInfo<diagnose::Technique>& info : kChoices<diagnose::Technique>)
        json["by_technique"][std::string(info.name)] =
            bench::interval_json(estimate.shares->found_by[static_cast<std::size_t>(info.value)]);
    json["by_bounces"] = Json::array();
    for (const Interval& share : estimate.shares->bounces) json["by_bounces"].push_back(bench::interval_json(share));
    for (std::size_t i = 0; i < estimate.shares->lights.size(); ++i)
        json["by_light"][diagnose::kNoiseLights[i]] = bench::interval_json(estimate.shares->lights[i]);
    return json;
}

Json mark_json(const Interval& net) {
    return {{"mark", mark_name(verdict_of(net))}, {"gain", net.value}, {"interval", {net.low, net.high}}};
}

Json pixel_gain_json(const Gain& gain) {
    Json json = mark_json(gain.net);
    json["samples"] = bench::interval_json(gain.samples);
    json["cost"] = bench::interval_json(gain.cost);
    return json;
}

}  // namespace

std::string noise_text(const NoiseOfPicture& picture) {
    const diagnose::PixelNoise& noise = picture.noise;
    const auto width = static_cast<std::uint32_t>(picture.width);
    const std::string_view base = info_of(baseline_method()).name;
    std::string text = fmt::format("pixel {},{}: {} paths by each method\n", noise.pixel % width, noise.pixel / width,
                                   noise.plain.paths);
    text += estimate_text(base, noise.plain);
    if (!noise.guided) return text;
    const std::string_view method = info_of(noise.guided_method).name;
    text += estimate_text(fmt::format("{}, trained by {} passes", method, picture.passes), *noise.guided);
    if (!noise.gain) return text + "gain: undecided, a method has no noise here\n";
    return text + fmt::format("{} {} here: {}\n", method, mark_name(verdict_of(noise.gain->net)),
                              headline(*noise.gain, std::string(base)));
}

Json noise_json(const NoiseOfPicture& picture) {
    const diagnose::PixelNoise& noise = picture.noise;
    const auto width = static_cast<std::uint32_t>(picture.width);
    Json json{{"pixel", {noise.pixel % width, noise.pixel / width}},
              {"passes", picture.passes},
              {"estimates", {estimate_json(info_of(baseline_method()).name, noise.plain)}},
              {"gain", noise.gain ? pixel_gain_json(*noise.gain) : Json()}};
    if (noise.guided) json["estimates"].push_back(estimate_json(info_of(noise.guided_method).name, *noise.guided));
    return json;
}

Json tile_gains_json(const TileGains& gains) {
    Json json{{"columns", gains.columns},
              {"rows", gains.rows},
              {"picture", mark_json(gains.picture)},
              {"tiles", Json::array()}};
    for (const Interval& tile : gains.tiles) json["tiles"].push_back(mark_json(tile));
    return json;
}

namespace {

/// A loaded field is taken as it is, unless limits ask for more training. `default` has nothing to learn.
bool needs_no_training(const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const bool is_loaded = !options.load_field.empty() && method.learns && !options.spp;
    return !method.uses_field || is_loaded;
}

}  // namespace

int trace_noise(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console) {
    if (!needs_no_training(options)) run_passes(session, options, *interrupt.flag(), console, Until::Learned);
    const FilmSlot slot = slot_of(options.render);
    const auto pixel = static_cast<std::uint32_t>(options.pixel->y * options.render.width + options.pixel->x);
    diagnose::PixelNoiseTracer tracer(diagnose::pass_pair(session, slot), pixel);
    while (tracer.paths() < options.why_samples && tracer.advance(interrupt.flag())) {
    }
    if (!tracer.has_all_groups()) {
        console.log().warning("interrupted: too few paths for an estimate");
        return kExitInterrupted;
    }
    const diagnose::PixelNoise noise = tracer.noise();
    const std::optional<FieldStatus> field = session.field_status(slot.method);
    const NoiseOfPicture report{noise, options.render.width, field ? field->passes : 0};
    if (console.json())
        console.event("noise", noise_json(report));
    else
        console.result(noise_text(report));
    return interrupt.raised() ? kExitInterrupted : 0;
}

namespace {

bool is_json(const Options& options) { return std::filesystem::path(options.gain_file).extension() == ".json"; }

/// Renders until the charged time is reached, and both halves have passes.
bool render_for(Session& session, FilmSlot slot, double seconds, const InterruptGuard& interrupt) {
    while (session.passes(slot) < 2 || charged_seconds(session.clocks(slot)) < seconds)
        if (session.advance(slot, interrupt.flag()) == Progress::Stopped) return false;
    return true;
}

TimedHalves timed(const Snapshot& snapshot) {
    return {.halves = halves_of(snapshot.halves), .seconds = charged_seconds(snapshot.clocks)};
}

}  // namespace

void require_gain(const Options& options) {
    if (options.gain_file.empty()) return;
    const MethodInfo& method = info_of(options.render.method);
    if (!method.uses_field)
        throw Error(ErrorKind::Usage, fmt::format("--gain: compares a guided method with default: expected --method "
                                                  "precomputed or reinforcement, got {}",
                                                  method.name));
    if (!is_json(options) && image_kind(options.gain_file) != ImageKind::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--gain: expected a .json or .png file, got '{}'", options.gain_file));
    if (!is_json(options)) require_viewer_code(options.gain_file);
    require_writable(options.gain_file);
}

bool write_gain(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console) {
    const FilmSlot slot = slot_of(options.render);
    const FilmSlot base{baseline_method(), slot.view};
    if (!render_for(session, slot, 0.0, interrupt)) return false;
    const Snapshot method = session.snapshot_with_halves(slot);
    if (!render_for(session, base, charged_seconds(method.clocks), interrupt)) return false;
    const Snapshot baseline = session.snapshot_with_halves(base);
    const TileGains gains = tile_gains(timed(baseline), timed(method), method.width);
    if (is_json(options))
        write_file_atomic(options.gain_file, tile_gains_json(gains).dump(2) + "\n");
    else
        write_png8(options.gain_file, draw_gains(session, slot, gains, options.display),
                   {{"Software", "pathlight " PL_VERSION}});
    console.remark(fmt::format("{}: {} {} in the time to the same noise\n", options.gain_file,
                               info_of(slot.method).name, mark_text(gains.picture)));
    return true;
}

}  // namespace pl
