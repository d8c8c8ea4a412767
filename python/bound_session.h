// A session as Python holds it: what `pathlight render` does, call by call.
#pragma once

#include <atomic>
#include <optional>

#include "app/options.h"
#include "app/run_passes.h"
#include "python/bound_field.h"
#include "python/bound_scene.h"
#include "python/caller.h"
#include "python/convert.h"

namespace pl {

class BoundSession {
public:
    /// `options`: as on the command line, with '_' for '-'.
    BoundSession(const BoundScene& scene, const nb::object& learner, const nb::kwargs& options);

    /// Renders until the film has `spp` samples per pixel, for so many seconds, or down to that noise; without limits as the command
    /// line. Throws what signal handlers of Python raise, after an orderly stop.
    void render(const nb::object& spp, const nb::object& seconds, const nb::object& target_error);

    std::uint32_t passes() const;
    NumpyArray<float> film() const;
    nb::tuple halves() const;
    nb::object statistics() const;
    BoundField field() const;
    void save(const std::filesystem::path& path) const;
    /// Command line of the window that shows scene and settings, and what has been learned, of which a copy is written to `folder`.
    std::string view_command(const std::filesystem::path& folder, const nb::kwargs& options) const;
    nb::bytes png() const;
    std::string text() const;

    /// None: the table's own learning.
    void set_learner(const nb::object& learner);
    const nb::object& called() const { return learner_; }
    void drop_called();

private:
    SoleUse use() const { return {is_used_, "session"}; }
    FilmSlot slot() const { return slot_of(options_.render); }
    Snapshot snapshot() const;
    Json statistics_of(const Snapshot& snapshot) const;
    std::string command(Command subcommand, const Options& shown) const;

    BoundScene scene_;
    nb::object learner_;  ///< null without one
    Options options_;
    std::optional<Session> session_;
    RunOutcome outcome_;  ///< of the last call of render()
    std::optional<ErrorTarget> target_;
    mutable std::atomic<bool> is_used_{false};
};

}  // namespace pl
