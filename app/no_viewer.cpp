// In the place of view.cpp and scene_picture.cpp: what a build without a viewer answers, and the Python module, which has none.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/scene_picture.h"
#include "core/base/error.h"

namespace pl {

int run_view(const CommandLine& line, Console&) {
    throw Error(ErrorKind::Unavailable,
                "this build has no viewer (it needs SDL2 and Dear ImGui); without one: pathlight render " +
                    line.options.scene + " -o picture.png");
}

void require_viewer_code(const std::string& option) {
    throw Error(ErrorKind::Unavailable,
                fmt::format("{} needs the drawing code of the viewer, which this build lacks", option));
}

ByteImage draw_in_scene(Session&, std::int32_t, const Options&) { return {}; }
ByteImage draw_discs(const VolumeInspection&, const CameraDescription&, const std::vector<std::string>&,
                     const LightReport*) {
    return {};
}
ByteImage draw_gains(Session&, FilmSlot, const TileGains&, const DisplaySettings&) { return {}; }
ByteImage draw_path_lines(Session&, const std::vector<diagnose::PathRecord>&, const Options&) { return {}; }
struct FieldPast::Kept {};
FieldPast::FieldPast() = default;
FieldPast::~FieldPast() = default;
std::uint32_t FieldPast::next(std::uint32_t passes) { return passes + 1; }
void FieldPast::observe(const Session&, MethodId) {}
std::vector<HistoryPoint> FieldPast::points(const IncidentLight&, std::int32_t, TargetLight) const { return {}; }
ByteImage draw_history(const std::vector<HistoryPoint>&) { return {}; }

}  // namespace pl
