#include "app/noise_report.h"

#include <fmt/format.h>

#include "core/bench/bench_results.h"
#include "core/session/methods.h"

namespace pl {
namespace {

constexpr const char* kNoiseLights[] = {"surfaces", "environment"};

std::string bounce_name(std::size_t bounces) {
    return bounces + 1 < diagnose::kBounceClasses ? fmt::format("{}", bounces) : fmt::format("{} or more", bounces);
}

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
    for (const diagnose::FoundByInfo& info : diagnose::all_found_by())
        text += share_line(info.label, shares.found_by[static_cast<std::size_t>(info.id)]);
    text += "  noise by bounces\n";
    for (std::size_t i = 0; i < diagnose::kBounceClasses; ++i) text += share_line(bounce_name(i), shares.bounces[i]);
    text += "  noise by light\n";
    for (std::size_t i = 0; i < shares.lights.size(); ++i) text += share_line(kNoiseLights[i], shares.lights[i]);
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
    for (const diagnose::FoundByInfo& info : diagnose::all_found_by())
        json["by_technique"][std::string(info.name)] =
            bench::interval_json(estimate.shares->found_by[static_cast<std::size_t>(info.id)]);
    json["by_bounces"] = Json::array();
    for (const Interval& share : estimate.shares->bounces) json["by_bounces"].push_back(bench::interval_json(share));
    for (std::size_t i = 0; i < estimate.shares->lights.size(); ++i)
        json["by_light"][kNoiseLights[i]] = bench::interval_json(estimate.shares->lights[i]);
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

}  // namespace pl
