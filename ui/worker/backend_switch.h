// The back ends of one session: each is made on the first request, kept for its return, dropped when it fails, and
// made anew on the next request. Used by the render thread only.
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/session/session.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

class BackendSwitch {
public:
    using Make = std::function<std::unique_ptr<RenderBackend>(const std::string& name)>;
    /// The back end that takes over when another fails.
    static constexpr std::string_view kFallback = "cpu";

    BackendSwitch(Make make, BackendChoices choices, std::string first);

    /// Name of the back end in use.
    const std::string& current() const { return current_; }
    bool on_fallback() const { return current_ == kFallback; }
    /// All back ends with their devices and failures so far.
    std::shared_ptr<const BackendChoices> choices() const { return choices_; }

    /// Moves the session to another back end, with all learned tables; returns the message about it. Throws if the
    /// other back end is unavailable or fails: then the session is unchanged, and the next try makes the other one
    /// anew.
    WorkerMessage switch_to(Session& session, const std::string& name);
    /// One more of the current kind, for a session beside the first.
    std::shared_ptr<RenderBackend> make_another() const { return make_(current_); }
    /// The current back end failed with this error and is dropped: moves the session to the fallback, with the
    /// learned tables if the failed one still returns them. Returns the message about it. Throws if the fallback
    /// fails, too.
    WorkerMessage take_over(Session& session, const std::exception& error);
    /// Makes the session, on the first back end or else on the fallback; then `told` is called with the reason.
    /// Throws if there is no fallback or if it fails, too.
    std::unique_ptr<Session>
    start(const std::function<std::unique_ptr<Session>(std::shared_ptr<RenderBackend>)>& make,
          const std::function<void(const WorkerMessage&)>& told);

private:
    std::shared_ptr<RenderBackend> get(const std::string& name);
    void adopt(const std::string& name, std::shared_ptr<RenderBackend> backend);
    void give_up(const std::string& name, const std::string& reason);
    BackendChoice choice(const std::string& name) const;
    void change_choice(const BackendChoice& changed);

    Make make_;
    std::shared_ptr<const BackendChoices> choices_;  ///< replaced, never changed: the window reads it
    std::string current_;
    std::map<std::string, std::shared_ptr<RenderBackend>> made_;
};

/// False for errors of requests and files, which any back end would report.
bool is_fault_of_backend(const std::exception& error);

/// Display name: "CPU" for "cpu".
std::string back_end_label(const std::string& name);
/// The text of an error without the name of the back end, which some errors begin with.
std::string reason_of(const std::exception& error, const std::string& backend);

}  // namespace pl::ui
