#include "app/scene_picture.h"

#include <fmt/format.h>

#include "core/io/load_scene.h"
#include "ui/model/shown_volumes.h"
#include "ui/pictures.h"

namespace pl {
namespace {

ui::PicturePainter painter() { return ui::PicturePainter(find_assets_dir() / "fonts" / "roboto-medium-latin.ttf"); }

/// Keeps all frames of a run of the program, up to a gibibyte.
ui::FieldHistoryRecorder recorder_for_run() {
    ui::FieldHistoryRecorder recorder;
    recorder.set_limit(std::size_t{1} << 30);
    return recorder;
}

/// Light samples alone: little noise after a few passes, and no sample of it trains the field.
ui::PublishedFrame frame_behind(Session& session, const Options& options) {
    constexpr std::uint32_t kPasses = 8;
    const FilmSlot slot{baseline_method(), View::Direct};
    while (session.passes(slot) < kPasses) session.advance(slot);
    return ui::frame_of(session, slot, options.display);
}

}  // namespace

void require_viewer_code(const std::string&) {}

ByteImage draw_in_scene(Session& session, std::int32_t volume, const Options& options) {
    const MethodId method = options.render.method;
    if (options.drawn == HemisphereDisplay::Flowers) {
        ui::FieldHistoryRecorder recorder = recorder_for_run();
        recorder.observe(session, method);
        return painter().flowers(frame_behind(session, options), *recorder.history()->frames.back());
    }
    const auto read = std::make_shared<const VolumeInspection>(session.inspect_volume(method, volume));
    return painter().volumes(frame_behind(session, options), {read},
                             options.drawn == HemisphereDisplay::Dome ? ui::LobeShape::Dome : ui::LobeShape::Lobe);
}

ByteImage draw_discs(const VolumeInspection& volume, const CameraDescription& camera,
                     const std::vector<std::string>& lines, const LightReport* truth) {
    std::vector<std::pair<ui::ShownDisc, ValueRange>> discs;
    const auto add = [&](std::initializer_list<ui::ShownDisc> row) {
        std::vector<float> all;
        for (const ui::ShownDisc& disc : row) all.insert(all.end(), disc.values.begin(), disc.values.end());
        for (const ui::ShownDisc& disc : row) discs.emplace_back(disc, range_of(all, {}));
    };
    if (truth == nullptr) {
        add({{"incident radiance", volume.radiance}});
        add({{"probability", volume.probability}});
        add({{"visits", {volume.visits.begin(), volume.visits.end()}}});
    } else {
        add({{"learned radiance", volume.radiance},
             {fmt::format("true radiance, {}", label_of(truth->target)), truth->light.target}});
        add({{"density of guided paths", ui::relative_to_cosine(truth->mixture_shares)},
             {"product with the BSDF", ui::relative_to_cosine(truth->product_shares)}});
    }
    return painter().discs(volume, camera, lines, discs, truth == nullptr ? 520.0f : 380.0f);
}

ByteImage draw_gains(Session& session, FilmSlot slot, const TileGains& gains, const DisplaySettings& display) {
    return painter().gains(ui::frame_of(session, slot, display), gains);
}

ByteImage draw_path_lines(Session& session, const std::vector<diagnose::PathRecord>& paths, const Options& options) {
    diagnose::PixelPaths drawn;
    drawn.plain = paths;
    return painter().paths(frame_behind(session, options), drawn);
}

struct FieldPast::Kept {
    ui::FieldHistoryRecorder recorder = recorder_for_run();
};

FieldPast::FieldPast() : kept_(std::make_unique<Kept>()) {}
FieldPast::~FieldPast() = default;

std::uint32_t FieldPast::next(std::uint32_t passes) { return static_cast<std::uint32_t>(ui::next_key_frame(passes)); }

void FieldPast::observe(const Session& session, MethodId method) { kept_->recorder.observe(session, method); }

std::vector<HistoryPoint> FieldPast::points(const IncidentLight& light, std::int32_t volume,
                                            TargetLight target) const {
    const ui::FieldHistory& history = *kept_->recorder.history();
    const std::vector<ui::FigurePoint> past = ui::past_figures(light, history, volume, target);
    if (past.empty()) return {};
    const std::vector<float> end = history.frames.back()->inspect(volume).probability;
    auto frame = history.frames.end() - static_cast<std::ptrdiff_t>(past.size());  // volumes are only ever added
    std::vector<HistoryPoint> points;
    for (const ui::FigurePoint& point : past) {
        const ui::ShareDifference apart = ui::difference(end, (*frame++)->inspect(volume).probability);
        points.push_back({.passes = point.passes,
                          .figures = point.figures,
                          .divergence_to_end = apart.divergence,
                          .variation_to_end = apart.total_variation});
    }
    return points;
}

ByteImage draw_history(const std::vector<HistoryPoint>& points) {
    std::vector<ui::FigurePoint> figures;
    for (const HistoryPoint& point : points) figures.push_back({point.passes, point.figures});
    return painter().figures(figures, 640, 260);
}

}  // namespace pl
