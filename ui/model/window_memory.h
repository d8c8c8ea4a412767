// The memory of a window between starts: its place, its layout and its displays, as a JSON file. No setting that
// changes a picture: the same command line makes the same picture after any use of the window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/json_file.h"
#include "ui/model/display_controls.h"
#include "ui/model/window_place.h"
#include "ui/model/window_state.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

class ViewerModel;

/// The defaults are those of a first start.
struct WindowMemory {
    std::optional<WindowPlace> place;
    float ui_scale = 0.0f;  ///< 0: by the screen
    WindowLayout layout = WindowLayout::Explore;
    PanelChoice panels;  ///< without `shown`: a start never hides all panels
    bool hemisphere = true;
    float tint_opacity = DisplayControls::kStandardOpacity;
    bool coarser_in_motion = true;
    bool preview_in_motion = true;
    CurveKind plot;
    std::vector<std::string> recent{};
    int tour_step = 0;              ///< of the guided tour, where it continues
    bool is_tour_answered = false;  ///< it is not offered again

    friend bool operator==(const WindowMemory&, const WindowMemory&) = default;
};

inline constexpr std::string_view kWindowMemorySchema = "pathlight.viewer/1";

/// Writes the members into `document`, whose other members stay.
void write_memory(const WindowMemory& memory, Json& document);

/// Members that are missing keep the values of `first`. Throws Error(Input) for a wrong type or a value out of range,
/// with the names of file and member.
WindowMemory memory_in(const Json& document, const WindowMemory& first, const std::filesystem::path& path);

/// The state of the window now; place and scale are those of `before`.
WindowMemory memory_of(const ViewerModel& model, const WindowMemory& before);

/// The window as it was remembered, without place and scale.
void restore(const WindowMemory& memory, ViewerModel& model);

const char* name_of(WindowLayout layout);

}  // namespace pl::ui
