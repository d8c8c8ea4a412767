#include "app/scene_picture.h"

#include <fmt/format.h>

#include "core/base/error.h"

#if PL_VIEWER

#include "core/io/load_scene.h"
#include "ui/model/shown_volumes.h"
#include "ui/pictures.h"

namespace pl {
namespace {

PicturePainter painter() { return PicturePainter(find_assets_dir() / "fonts" / "roboto-medium-latin.ttf"); }

/// Light samples alone: little noise after a few passes, and no sample of it changes what was learned.
PublishedFrame frame_behind(Session& session, const Options& options) {
    constexpr std::uint32_t kPasses = 8;
    const FilmSlot slot{baseline_method(), View::Direct};
    while (session.passes(slot) < kPasses) session.advance(slot);
    return frame_of(session, slot, options.display);
}

}  // namespace

void require_viewer_code(const std::string&) {}

ByteImage draw_in_scene(Session& session, std::int32_t volume, const Options& options) {
    const MethodId method = options.render.method;
    if (options.drawn == "flowers") {
        FieldHistoryRecorder recorder;
        recorder.set_limit(std::size_t{1} << 30);
        recorder.observe(session, method);
        return painter().flowers(frame_behind(session, options), *recorder.history()->frames.back());
    }
    const auto read = std::make_shared<const VolumeInspection>(session.inspect_volume(method, volume));
    return painter().volumes(frame_behind(session, options), {read},
                             options.drawn == "dome" ? LobeShape::Dome : LobeShape::Lobe);
}

ByteImage draw_path_lines(Session& session, const std::vector<PathRecord>& paths, const Options& options) {
    PixelPaths drawn;
    drawn.plain = paths;
    return painter().paths(frame_behind(session, options), drawn);
}

struct FieldPast::Kept {
    FieldHistoryRecorder recorder;
};

FieldPast::FieldPast() : kept_(std::make_unique<Kept>()) { kept_->recorder.set_limit(std::size_t{1} << 30); }
FieldPast::~FieldPast() = default;

void FieldPast::observe(const Session& session, MethodId method) { kept_->recorder.observe(session, method); }

std::vector<HistoryPoint> FieldPast::points(const IncidentLight& light, std::int32_t volume,
                                            TargetLight target) const {
    const FieldHistory& history = *kept_->recorder.history();
    std::vector<HistoryPoint> points;
    if (history.frames.empty()) return points;
    const std::vector<float> end = history.frames.back()->inspect(volume).probability;
    for (const auto& frame : history.frames) {
        if (static_cast<std::size_t>(volume) >= frame->volumes()) continue;
        const VolumeInspection then = frame->inspect(volume);
        const ShareDifference apart = difference(end, then.probability);
        points.push_back({.passes = frame->passes(),
                          .figures = LightComparison(light, then, target).figures(),
                          .divergence_to_end = apart.divergence,
                          .variation_to_end = apart.total_variation});
    }
    return points;
}

ByteImage draw_history(const std::vector<HistoryPoint>& points) {
    std::vector<FigurePoint> figures;
    for (const HistoryPoint& point : points) figures.push_back({point.passes, point.figures});
    return painter().figures(figures, 640, 260);
}

}  // namespace pl

#else

namespace pl {

void require_viewer_code(const std::string& option) {
    throw Error(ErrorKind::Unavailable,
                fmt::format("{} needs the drawing code of the viewer, which this build lacks", option));
}

ByteImage draw_in_scene(Session&, std::int32_t, const Options&) { return {}; }
ByteImage draw_path_lines(Session&, const std::vector<PathRecord>&, const Options&) { return {}; }
struct FieldPast::Kept {};
FieldPast::FieldPast() = default;
FieldPast::~FieldPast() = default;
void FieldPast::observe(const Session&, MethodId) {}
std::vector<HistoryPoint> FieldPast::points(const IncidentLight&, std::int32_t, TargetLight) const { return {}; }
ByteImage draw_history(const std::vector<HistoryPoint>&) { return {}; }

}  // namespace pl

#endif
