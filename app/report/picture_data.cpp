#include "app/report/picture_data.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/report/convergence_plots.h"
#include "app/report/markup.h"
#include "core/io/picture_file.h"

namespace pl {
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
    const Rgb color = method_color(run.cell.method);
    return {{"title", fmt::format("{}, {}", run.cell.method, run.cell.backend)},
            {"color", fmt::format("rgb({},{},{})", color[0], color[1], color[2])},
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

}  // namespace pl
