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
#include "ui/model/messages.h"
#include "ui/model/window_state.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

class ViewerModel;

/// The defaults are the state of a first start.
struct WindowMemory {
    std::optional<WindowPlace> place;
    float ui_scale = 0.0f;  ///< 0: by the screen
    Theme theme = Theme::Dark;
    WindowLayout layout = WindowLayout::Explore;
    PanelChoice panels;  ///< without `shown`: a start never hides all panels
    bool hemisphere = true;
    float tint_opacity = DisplayControls::kStandardOpacity;
    bool coarser_in_motion = true;
    bool preview_in_motion = true;
    bool denoised_preview = true;
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

/// The state of the window now; place and scale are taken from `before`.
WindowMemory memory_of(const ViewerModel& model, const WindowMemory& before);

/// The window as it was remembered, without place and scale.
void restore(const WindowMemory& memory, ViewerModel& model);

const char* name_of(WindowLayout layout);

/// The file in which the window is remembered. Its faults never keep the viewer from starting, running or closing.
class RememberedWindow {
public:
    /// A change is written after this time without another one.
    static constexpr double kRestSeconds = 2.0;

    /// Reads the file; an empty name remembers nothing. `first` is the state of a first start. A file that is not of this
    /// version or has a fault leaves `first` in place; problem() says so.
    RememberedWindow(std::filesystem::path file, const WindowMemory& first);

    /// The state that was read, or that was written last.
    const WindowMemory& last() const { return last_; }
    /// Whether there was no file, of a program that remembers: a first start.
    bool is_new() const { return is_new_; }
    /// Why the file was not taken; empty if it was, or if there is none.
    const std::string& problem() const { return problem_; }

    /// Once per frame of the window, with its clock: writes changes that are complete. The first write that fails is a
    /// message; there is no other attempt before the window closes.
    void update(const WindowMemory& now, double seconds, Messages& messages);

    /// At the end: writes the changes since the last write. Returns why that failed, empty if it did not.
    std::string finish(const WindowMemory& now);

    /// Removes the file. `now` is the state of a first start; it is written when it changes again.
    void forget(const WindowMemory& now, double seconds, Messages& messages);

private:
    std::string write(const WindowMemory& now);

    std::filesystem::path file_;
    Json document_ = Json::object();  ///< with members that this version does not know
    std::string problem_;
    bool is_new_ = false;
    WindowMemory last_;
    WindowMemory waiting_;  ///< not written yet
    double changed_at_ = 0.0;
    double settled_at_ = 0.0;  ///< the desktop answers a reset until then
    bool has_failed_ = false;
};

}  // namespace pl::ui
