#include "app/inspection_file.h"

#include <cmath>

#include <fmt/format.h>

#include "app/parse_values.h"
#include "core/base/error.h"
#include "core/bench/bench_results.h"
#include "core/fields/disc_frame.h"
#include "core/io/files.h"
#include "core/kernel/base/frame.h"
#include "core/kernel/guiding/direction_cells.h"

namespace pl {
namespace {

std::vector<Vec3f> world_directions(const VolumeInspection& volume) {
    const DirectionCells cells{.side = volume.side};
    const Frame frame = make_frame(volume.normal);
    std::vector<Vec3f> directions;
    for (int cell = 0; cell < cells.count(); ++cell)
        directions.push_back(frame.to_world(square_to_cosine_hemisphere(cells.point_in_cell(cell, {0.5f, 0.5f}))));
    return directions;
}

ImageMetadata metadata_of(const VolumeInspection& volume, const InspectionSource& source) {
    ImageMetadata metadata{{"Software", "pathlight " PL_VERSION},    {"scene", source.scene},
                           {"scene_hash", source.scene_hash},        {"method", source.method},
                           {"spp", std::to_string(source.spp)},      {"seed", std::to_string(source.seed)},
                           {"volume", std::to_string(volume.volume)}};
    if (source.partial) metadata.emplace_back("partial", "true");
    return metadata;
}

Json bounds_json(const Interval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json truth_json(const LightReport& truth) {
    const GuidingFigures& figures = truth.figures;
    return {{"paths_per_cell", truth.paths_per_cell},
            {"invalid_paths", truth.invalid_paths},
            {"target_light", name_of(truth.target)},
            {"table_divergence", bounds_json(figures.table)},
            {"mixture_divergence", bounds_json(figures.mixture)},
            {"variance_factor", figures.variance_factor ? bounds_json(*figures.variance_factor) : Json()},
            {"radiance", truth.light.radiance},
            {"radiance_error", truth.light.radiance_error},
            {"target", truth.light.target},
            {"product", truth.product_shares},
            {"mixture", truth.mixture_shares}};
}

std::string short_vector(const Vec3f& v) {
    const Vec3f positive_zeros = v + 0.0f;
    return fmt::format("{:.3g}, {:.3g}, {:.3g}", positive_zeros.x, positive_zeros.y, positive_zeros.z);
}

/// The lines above the discs: origin, volume, position, and the world directions of the discs' axes.
std::vector<std::string> disc_lines(const VolumeInspection& volume, const InspectionSource& source) {
    const DiscFrame frame(volume.normal, source.camera);
    std::vector<std::string> lines{fmt::format("{}, {}, {} spp", source.scene, source.method, source.spp),
                                   fmt::format("volume {}, {} directions, mean radiance {:.3g}", volume.volume,
                                               volume.side * volume.side, volume.mean_radiance),
                                   fmt::format("position {}", short_vector(volume.position)),
                                   fmt::format("normal {} (cross in the center)", short_vector(volume.normal)),
                                   fmt::format("right {}", short_vector(frame.right())),
                                   fmt::format("up {} (arrow{}), camera: ring", short_vector(frame.up()),
                                               frame.up_is_scene() ? "" : ", up in the picture"),
                                   "logarithmic colors"};
    if (!source.truth) return lines;
    const std::vector<std::string> figures = truth_lines(*source.truth);
    lines.insert(lines.end(), figures.begin(), figures.end());
    return lines;
}

}  // namespace

std::vector<std::string> truth_lines(const LightReport& truth) {
    const GuidingFigures& figures = truth.figures;
    std::vector<std::string> lines{
        fmt::format("truth: {} paths per cell, incident light: {}", truth.paths_per_cell, name_of(truth.target)),
        fmt::format("KL divergence of the table {} nats", interval_text(figures.table)),
        fmt::format("KL divergence of the mixture {} nats", interval_text(figures.mixture)),
        figures.variance_factor
            ? fmt::format("variance by the mixture / by BSDF sampling {}", interval_text(*figures.variance_factor))
            : "BSDF sampling has no variance here"};
    if (truth.invalid_paths > 0) lines.push_back(fmt::format("invalid paths: {}", truth.invalid_paths));
    return lines;
}

InspectionKind inspection_kind(const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix == ".json") return InspectionKind::AsJson;
    if (suffix == ".csv") return InspectionKind::AsCsv;
    if (suffix == ".png") return InspectionKind::AsPng;
    throw Error(ErrorKind::Usage,
                fmt::format("{}: the suffix decides what is written: expected .json, .csv or .png, got {}",
                            path.string(), suffix.empty() ? "none" : suffix));
}

Json inspection_json(const VolumeInspection& volume, const InspectionSource& source) {
    Json directions = Json::array();
    for (const Vec3f& direction : world_directions(volume)) directions.push_back(vector_json(direction));
    Json json{{"schema", "pathlight.inspection/1"},
              {"scene", source.scene},
              {"scene_hash", source.scene_hash},
              {"method", source.method},
              {"spp", source.spp},
              {"seed", source.seed},
              {"partial", source.partial},
              {"volume", volume.volume},
              {"position", vector_json(volume.position)},
              {"normal", vector_json(volume.normal)},
              {"bins", volume.side * volume.side},
              {"side", volume.side},
              {"mean_radiance", volume.mean_radiance},
              {"bsdf_fraction", volume.bsdf_fraction},
              {"direction", directions},
              {"radiance", volume.radiance},
              {"probability", volume.probability},
              {"visits", volume.visits}};
    if (source.truth) json["truth"] = truth_json(*source.truth);
    return json;
}

std::string inspection_csv(const VolumeInspection& volume, const std::optional<LightReport>& truth) {
    const std::vector<Vec3f> directions = world_directions(volume);
    std::string text = "cell,row,column,dx,dy,dz,radiance,probability,visits";
    text += truth ? ",true_radiance,true_error,true_target,true_product,mixture\n" : "\n";
    const auto side = static_cast<std::size_t>(volume.side);
    for (std::size_t cell = 0; cell < directions.size(); ++cell) {
        text += fmt::format("{},{},{},{},{},{},{}", cell, cell / side, cell % side, print_vector(directions[cell]),
                            print_float(volume.radiance[cell]), print_float(volume.probability[cell]),
                            volume.visits[cell]);
        if (truth)
            for (const std::vector<float>* column :
                 {&truth->light.radiance, &truth->light.radiance_error, &truth->light.target, &truth->product_shares,
                  &truth->mixture_shares})
                text += fmt::format(",{}", print_float((*column)[cell]));
        text += "\n";
    }
    return text;
}

Json history_json(const std::vector<HistoryPoint>& points) {
    Json list = Json::array();
    for (const HistoryPoint& point : points) {
        const GuidingFigures& figures = point.figures;
        const bool is_finite = std::isfinite(point.divergence_to_end);
        list.push_back(
            {{"passes", point.passes},
             {"table_divergence", bench::interval_json(figures.table)},
             {"mixture_divergence", bench::interval_json(figures.mixture)},
             {"variance_factor", figures.variance_factor ? bench::interval_json(*figures.variance_factor) : Json()},
             {"divergence_to_end", is_finite ? Json(point.divergence_to_end) : Json()},
             {"variation_to_end", point.variation_to_end}});
    }
    return list;
}

std::string history_csv(const std::vector<HistoryPoint>& points) {
    std::string text =
        "passes,table,table_low,table_high,mixture,mixture_low,mixture_high,variance,variance_low,variance_high,"
        "divergence_to_end,variation_to_end\n";
    const auto columns = [](const Interval& i) {
        return fmt::format(",{:.9g},{:.9g},{:.9g}", i.value, i.low, i.high);
    };
    for (const HistoryPoint& point : points) {
        const auto& variance = point.figures.variance_factor;
        text += fmt::format("{}{}{}{},{:.9g},{:.9g}\n", point.passes, columns(point.figures.table),
                            columns(point.figures.mixture), variance ? columns(*variance) : ",,,",
                            point.divergence_to_end, point.variation_to_end);
    }
    return text;
}

void save_history(const std::filesystem::path& path, const std::vector<HistoryPoint>& points,
                  const VolumeInspection& volume, const InspectionSource& source) {
    switch (inspection_kind(path)) {
    case InspectionKind::AsJson:
        write_file_atomic(path, json_line({{"schema", "pathlight.history/1"},
                                           {"scene", source.scene},
                                           {"scene_hash", source.scene_hash},
                                           {"method", source.method},
                                           {"seed", source.seed},
                                           {"partial", source.partial},
                                           {"volume", volume.volume},
                                           {"frames", history_json(points)}}));
        return;
    case InspectionKind::AsCsv: write_file_atomic(path, history_csv(points)); return;
    case InspectionKind::AsPng: write_png8(path, draw_history(points), metadata_of(volume, source)); return;
    }
}

void save_inspection(const std::filesystem::path& path, const VolumeInspection& volume,
                     const InspectionSource& source) {
    switch (inspection_kind(path)) {
    case InspectionKind::AsJson: write_file_atomic(path, json_line(inspection_json(volume, source))); return;
    case InspectionKind::AsCsv: write_file_atomic(path, inspection_csv(volume, source.truth)); return;
    case InspectionKind::AsPng:
        write_png8(
            path,
            draw_discs(volume, source.camera, disc_lines(volume, source), source.truth ? &*source.truth : nullptr),
            metadata_of(volume, source));
        return;
    }
}

}  // namespace pl
