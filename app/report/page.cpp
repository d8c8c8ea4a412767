#include "app/report/page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/report/bench_plots.h"
#include "core/base/printable.h"
#include "core/io/picture_file.h"

namespace pl {

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63u];
    }
    return text;
}

namespace {

/// The middle of a picture, unscaled: scaling would average away the noise.
LinearImage middle_of(const LinearImage& image) {
    const int width = std::min(image.width, kMostSide);
    const int height = std::min(image.height, kMostSide);
    const int left = (image.width - width) / 2;
    const int top = (image.height - height) / 2;
    LinearImage result{.width = width, .height = height, .pixels = {}};
    for (int row = 0; row < height; ++row) {
        const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(top + row) * image.width + left;
        result.pixels.insert(result.pixels.end(), first, first + width);
    }
    return result;
}

std::string data_url(const LinearImage& image, float exposure_ev) {
    LinearImage shown = middle_of(image);
    Snapshot snapshot;
    snapshot.width = shown.width;
    snapshot.height = shown.height;
    snapshot.pixels = std::move(shown.pixels);
    return "data:image/png;base64," + base64(encode_png8(display_image(snapshot, {.exposure_ev = exposure_ev})));
}

/// Exposure that brings all but the brightest twentieth of the reference below white.
float exposure_for(const LinearImage& reference) {
    std::vector<double> luminances;
    for (const glm::vec3& pixel : reference.pixels)
        if (is_finite(pixel)) luminances.push_back(luminance_of(Vec3d{pixel}));
    if (luminances.empty()) return 0.0f;
    const auto bright = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() * 19 / 20);
    std::nth_element(luminances.begin(), bright, luminances.end());
    return *bright > 0.0 ? static_cast<float>(std::clamp(std::log2(0.8 / *bright), -32.0, 32.0)) : 0.0f;
}

/// At most kMostSteps of the points, the last one among them.
std::vector<const RunPoint*> chosen_points(const RunSeries& series) {
    std::vector<const RunPoint*> points;
    const std::size_t count = std::min(series.points.size(), kMostSteps);
    for (std::size_t i = 1; i <= count; ++i) points.push_back(&series.points[i * series.points.size() / count - 1]);
    return points;
}

Json cell_data(const bench::BenchFolder& folder, const bench::BenchRun& run, float exposure_ev) {
    Json points = Json::array();
    for (const RunPoint* point : chosen_points(run.series)) {
        const std::filesystem::path path = folder.picture_path(run.cell, point->spp);
        if (!std::filesystem::exists(path)) continue;
        points.push_back({{"seconds", charged_seconds(point->clocks)},
                          {"spp", point->spp},
                          {"relmse", point->metrics.relmse},
                          {"picture", data_url(read_exr(path), exposure_ev)}});
    }
    return {{"title", fmt::format("{}, {}", run.cell.method, run.cell.backend)},
            {"color", fmt::format("#{:06x}", method_color(run.cell.method) & 0xffffffu)},
            {"points", points}};
}

Json scene_data(const bench::BenchFolder& folder, const bench::BenchResults& results, const std::string& scene) {
    Json data{{"scene", scene}, {"exposure_ev", 0.0f}, {"cropped", false}, {"reference", nullptr}};
    float exposure_ev = 0.0f;
    if (const auto path = folder.reference_picture_path(scene); std::filesystem::exists(path)) {
        const LinearImage reference = read_exr(path);
        exposure_ev = exposure_for(reference);
        data["cropped"] = reference.width > kMostSide || reference.height > kMostSide;
        data["reference"] = data_url(reference, exposure_ev);
    }
    data["exposure_ev"] = exposure_ev;
    Json cells = Json::array();
    for (const bench::CellSummary& cell : results.summary.cells)
        for (const bench::BenchRun& run : results.runs)
            if (cell.cell.scene == scene && run.cell == cell.cell && !run.warm_up &&
                run.seed == results.plan.at("first_seed").get<std::uint64_t>())
                cells.push_back(cell_data(folder, run, exposure_ev));
    data["cells"] = cells;
    return data;
}

}  // namespace

Json picture_data(const bench::BenchFolder& folder, const bench::BenchResults& results) {
    Json data = Json::array();
    for (const std::string& scene : scene_order(results.plan)) data.push_back(scene_data(folder, results, scene));
    return data;
}

namespace {

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, markup_text(cell));
    return text + "</tr>\n";
}

std::string headlines(const bench::BenchSummary& summary, const std::string& scene) {
    std::string text;
    for (const bench::Comparison& comparison : summary.comparisons)
        if (comparison.cell.scene == scene)
            text += fmt::format("<p class=\"headline\"><b>{}</b> on {} {}.</p>\n",
                                markup_text(comparison.cell.method), markup_text(comparison.cell.backend),
                                markup_text(headline(comparison.gain, comparison.base_method)));
    return text;
}

std::string cell_table(const bench::BenchSummary& summary, const std::string& scene) {
    std::string text = "<table>\n" + row({"method", "back end", "runs", "relMSE at the end", "trimmed", "MSE", "FLIP",
                                          "seconds", "set-up s", "ms per sample", "slope", "bias %", "warm-up s"},
                                         "th");
    for (const bench::CellSummary& cell : summary.cells) {
        if (cell.cell.scene != scene) continue;
        const std::size_t runs = cell.ends.size();
        const Interval bias{100.0 * cell.signed_bias_interval.value, 100.0 * cell.signed_bias_interval.low,
                            100.0 * cell.signed_bias_interval.high};
        text += row({cell.cell.method, cell.cell.backend, std::to_string(runs),
                     bench::interval_text(cell.final_error, runs), bench::interval_text(cell.final_trimmed, runs),
                     bench::interval_text(cell.final_mse, runs), bench::interval_text(cell.final_flip, runs),
                     bench::interval_text(cell.seconds, runs), bench::interval_text(cell.setup_seconds, runs),
                     fmt::format("{:.3g}", 1e3 * cell.seconds_per_sample.value),
                     bench::interval_text(cell.slope, runs), bench::interval_text(bias, runs),
                     cell.warm_up_seconds > 0.0 ? fmt::format("{:.3g}", cell.warm_up_seconds) : "none"});
    }
    return text + "</table>\n";
}

std::string time_text(const TimeToTarget& time) {
    if (time.reached == 0) return fmt::format("> {:.3g}", time.more_than);
    const std::string reached = bench::interval_text(time.cost, time.reached);
    if (time.censored == 0) return reached;
    return fmt::format("{}; {} of {} runs > {:.3g}", reached, time.censored, time.reached + time.censored,
                       time.more_than);
}

std::string target_table(const bench::BenchSummary& summary, const std::string& scene) {
    const std::vector<double> targets = summary.targets(scene);
    if (targets.empty()) return "";
    std::vector<std::string> head{"method", "back end"};
    for (const double target : targets) head.push_back(fmt::format("s to relMSE {:.2g}", target));
    std::string text = "<table>\n" + row(head, "th");
    for (const bench::CellSummary& cell : summary.cells) {
        if (cell.cell.scene != scene) continue;
        std::vector<std::string> cells{cell.cell.method, cell.cell.backend};
        for (const double target : targets) cells.push_back(time_text(time_to_target(cell.over_time, target)));
        text += row(cells);
    }
    return text + "</table>\n<p class=\"note\">Runs that do not reach an error are counted as '&gt;', never left "
                  "out in silence.</p>\n";
}

std::string viewer(std::size_t index, const Json& data, std::uint64_t seed) {
    if (data.at("cells").empty()) return "<p class=\"note\">No pictures.</p>\n";
    return fmt::format(
        "<div class=\"pictures\" id=\"viewer-{0}\" tabindex=\"0\">\n<div class=\"bar\">"
        "<label><input type=\"radio\" name=\"mode-{0}\" value=\"time\" checked> equal time</label>"
        "<label><input type=\"radio\" name=\"mode-{0}\" value=\"error\"> equal error</label>"
        "<input type=\"range\" min=\"0\" max=\"1000\" value=\"1000\" aria-label=\"time or "
        "error\"><output></output></div>"
        "<div class=\"grid\"></div>\n<p class=\"note\">Seed {1} of each, exposure {2:+.1f} EV{3}. Keys: arrows move "
        "the "
        "slider, M equal time or equal error, 1 to 9 one picture large, 0 the reference, Esc all.</p></div>\n",
        index, seed, data.at("exposure_ev").get<double>(),
        data.at("cropped").get<bool>() ? ", middle of the picture" : "");
}

std::string definitions() {
    return "<h2>What is measured</h2>\n<p>relMSE is (x-r)<sup>2</sup> / (r<sup>2</sup> + 0.01) in linear radiance, "
           "the mean "
           "over channels and pixels, with the reference in two independent halves, "
           "(x-r<sub>1</sub>)(x-r<sub>2</sub>), so "
           "that its noise drops out; trimmed: without the worst 0.1 % of the pixels. Time is placing volumes, "
           "precomputing, learning and rendering; loading, building, uploading and measuring are not in it. Every "
           "run starts "
           "with "
           "nothing learned. Intervals are 95 %, Student's on logarithms over runs, ratios by Welch. The slope of "
           "error "
           "over samples is -1 where only noise is left. Full definitions are in results.json.</p>\n";
}

std::string about(const bench::BenchResults& results) {
    std::string devices;
    for (const auto& [name, device] : results.plan.at("backends").items())
        devices += fmt::format("{}{}: {}, {} threads", devices.empty() ? "" : "; ", name,
                               device.at("device").get<std::string>(), device.at("threads").get<int>());
    double share = 0.0;
    for (const bench::CellSummary& cell : results.summary.cells) share = std::max(share, cell.measure_share);
    return fmt::format(
        "<p>{}; pathlight {}, commit {}; {}. Runs are in shuffled blocks of one seed each; the first run of each "
        "method is a warm-up and left out. Measuring took up to {:.1f} % on top of the charged time.</p>\n"
        "<pre>{}</pre>\n",
        markup_text(results.date), PL_VERSION,
        markup_text(fmt::format("{}", fmt::join(bench::commits_of(results.runs), ", "))), markup_text(devices),
        100.0 * share, markup_text(results.command));
}

std::string warnings(const bench::BenchResults& results) {
    std::string text;
    if (!results.complete)
        text += "<p class=\"warning\">The bench was interrupted: these are the runs that were finished.</p>\n";
    std::uint64_t invalid = 0;
    std::size_t below = 0;
    std::size_t fewest = kGoodRuns;
    for (const bench::CellSummary& cell : results.summary.cells) {
        invalid += cell.invalid_samples;
        below += cell.below_reference;
        fewest = std::min(fewest, cell.ends.size());
    }
    if (fewest < kGoodRuns)
        text += fmt::format("<p class=\"warning\">As few as {} runs of a method: {}.</p>\n", fewest,
                            fewest < kFewestRuns ? "no intervals are shown" : "intervals are rough");
    if (invalid > 0)
        text += fmt::format("<p class=\"warning\">{} samples were NaN or infinite and left out.</p>\n", invalid);
    if (below > 0)
        text += fmt::format("<p class=\"warning\">{} runs ended below what the reference resolves.</p>\n", below);
    return text;
}

/// JSON for a script element, which tags and comments in it would end, or keep from ending.
std::string script_json(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
        text.replace(at, 1, "\\u003c");
    return text;
}

}  // namespace

std::string report_page(const bench::BenchResults& results, const std::vector<NamedPlot>& plots,
                        const Json& pictures) {
    std::string text =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<title>pathlight: what accuracy costs in time</title>\n<style>{}</style>\n</head>\n"
                    "<body>\n<h1>What accuracy costs in time</h1>\n",
                    kPageStyle);
    text += about(results) + warnings(results);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::string scene = pictures[i].at("scene");
        text += fmt::format("<h2>{}</h2>\n", markup_text(scene)) + headlines(results.summary, scene);
        for (const NamedPlot& plot : plots)
            if (plot.scene == scene) text += svg_plot(plot.plot);
        text += cell_table(results.summary, scene) + target_table(results.summary, scene) +
                viewer(i, pictures[i], results.plan.at("first_seed"));
    }
    text += definitions();
    text +=
        fmt::format("<script type=\"application/json\" id=\"pictures\">{}</script>\n<script>{}</script>\n</body>\n"
                    "</html>\n",
                    script_json(pictures), kPageScript);
    return text;
}

}  // namespace pl
