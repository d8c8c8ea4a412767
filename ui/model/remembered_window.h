// The file in which the window is remembered. Its faults never keep the viewer from starting, running or closing.
#pragma once

#include <filesystem>
#include <string>

#include "ui/model/messages.h"
#include "ui/model/window_memory.h"

namespace pl::ui {

class RememberedWindow {
public:
    /// A change is written after this time without another one.
    static constexpr double kRestSeconds = 2.0;

    /// Reads the file; an empty name remembers nothing. `first` is the state of a first start. A file that is not of this
    /// version or has a fault leaves `first` in place; problem() says so.
    RememberedWindow(std::filesystem::path file, const WindowMemory& first);

    /// The state that was read, or that was written last.
    const WindowMemory& last() const { return last_; }
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
    WindowMemory last_;
    WindowMemory waiting_;  ///< not written yet
    double changed_at_ = 0.0;
    double settled_at_ = 0.0;  ///< the desktop answers a reset until then
    bool has_failed_ = false;
};

}  // namespace pl::ui
