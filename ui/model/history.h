// Undo and redo of what the user has chosen: settings, exposure, materials, knobs and camera.
#pragma once

#include <string>
#include <vector>

#include "core/session/settings.h"

namespace pl::ui {

class ViewerModel;

/// All that undo goes back over.
struct Choices {
    RenderSettings settings;  ///< with the camera
    DisplaySettings display;
    std::vector<MaterialDescription> materials;
    std::vector<float> knobs;
};

class History {
public:
    static constexpr std::size_t kMost = 100;
    /// Changes of a number, a color or the camera within this time of the last one are one change, as the changes of one drag are.
    static constexpr double kMergeSeconds = 0.5;

    /// Once per frame of the window, with its clock: notes what has changed. Another scene begins a new history. `is_dragging`: a
    /// control is held.
    void update(const ViewerModel& model, double seconds, bool is_dragging);

    /// What undo() would undo, such as "light samples off"; empty if there is nothing.
    std::string undone_next() const { return now_ > 0 ? states_[now_].change : ""; }
    std::string redone_next() const { return now_ + 1 < states_.size() ? states_[now_ + 1].change : ""; }
    void undo(ViewerModel& model);
    void redo(ViewerModel& model);

private:
    struct State {
        Choices choices;
        std::string change{};  ///< that led to it
        std::size_t kind = 0;  ///< of that change
    };

    void go(ViewerModel& model, std::size_t state);

    std::string scene_;
    std::vector<State> states_;
    std::size_t now_ = 0;
    double changed_at_ = 0.0;
    bool is_same_drag_ = false;
};

}  // namespace pl::ui
