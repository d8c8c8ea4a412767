#include "ui/script/overlay_values.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "ui/model/window_choices.h"

namespace pl::ui {
namespace {

/// "12,34: 32 of 40", "none".
std::string traced_paths(const ViewerModel& model) {
    const PathExplorer& explorer = model.paths();
    if (explorer.paths() == nullptr) return "none";
    return fmt::format("{},{}: {} of {}", explorer.x(), explorer.y(), explorer.paths()->passes.size(),
                       explorer.paths()->searched);
}

/// "gains", "none".
std::string pixel_mark(const ViewerModel& model) {
    const diagnose::PixelNoise* const noise = model.paths().noise().noise();
    return noise != nullptr && noise->gain ? std::string(mark_name(verdict_of(noise->gain->net))) : "none";
}

constexpr std::array kOverlayValues{
    ScriptValue{"pins",
                [](const ViewerModel& m) {
                    const auto& places = m.selection().pins().places();
                    return fmt::format("{}",
                                       std::ranges::count_if(places, [](std::int32_t p) { return p != kNoVolume; }));
                }},
    ScriptValue{"lobes", [](const ViewerModel& m) { return std::string(pl::name_of(m.window().lobe_shape)); }},
    ScriptValue{"flowers",
                [](const ViewerModel& m) {
                    const bool shown = m.flowers().is_shown() && m.flowers().flowers() != nullptr;
                    return fmt::format("{}", shown ? m.flowers().flowers()->flowers.size() : 0);
                }},
    ScriptValue{"flowers_drawn", [](const ViewerModel& m) { return fmt::format("{}", m.flowers().counts().drawn); }},
    ScriptValue{"flower_triangles",
                [](const ViewerModel& m) { return fmt::format("{}", m.flowers().counts().triangles); }},
    ScriptValue{"flowers_made", [](const ViewerModel& m) { return fmt::format("{}", m.flowers().times_made()); }},
    ScriptValue{"key_frames",
                [](const ViewerModel& m) { return fmt::format("{}", m.time().history()->frames.size()); }},
    ScriptValue{"shown_pass",
                [](const ViewerModel& m) {
                    return m.time().frame() != nullptr ? fmt::format("{}", m.time().frame()->passes())
                                                       : std::string("now");
                }},
    ScriptValue{"curve_points",
                [](const ViewerModel& m) { return fmt::format("{}", m.selection().light().curve().size()); }},
    ScriptValue{"tracing_pixels",
                [](const ViewerModel& m) { return std::string(m.paths().is_shown() ? "yes" : "no"); }},
    ScriptValue{"tracing", [](const ViewerModel& m) { return std::string(m.paths().is_tracing() ? "yes" : "no"); }},
    ScriptValue{"paths", traced_paths},
    ScriptValue{"guided_paths",
                [](const ViewerModel& m) {
                    return fmt::format("{}", m.paths().paths() != nullptr ? m.paths().paths()->guided.size() : 0);
                }},
    ScriptValue{"selected_path",
                [](const ViewerModel& m) {
                    const auto index = m.paths().selected();
                    return index ? fmt::format("{}", m.paths().paths()->passes[*index]) : std::string("none");
                }},
    ScriptValue{"path_lines", [](const ViewerModel& m) { return fmt::format("{}", m.paths().times_made()); }},
    ScriptValue{"noise_paths",
                [](const ViewerModel& m) {
                    const diagnose::PixelNoise* const noise = m.paths().noise().noise();
                    return fmt::format("{}", noise != nullptr ? noise->plain.paths : 0);
                }},
    ScriptValue{"pixel_mark", pixel_mark},
    ScriptValue{"gain_tiles",
                [](const ViewerModel& m) {
                    return fmt::format("{}",
                                       m.gain_marks().gains() != nullptr ? m.gain_marks().gains()->tiles.size() : 0);
                }},
};

}  // namespace

std::span<const ScriptValue> overlay_values() { return kOverlayValues; }

}  // namespace pl::ui
