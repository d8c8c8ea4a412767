// A session as Python holds it: what `pathlight render` does, call by call.
#pragma once

#include <atomic>
#include <optional>

#include "app/options.h"
#include "app/run_passes.h"
#include "python/bound_field.h"
#include "python/bound_scene.h"
#include "python/convert.h"

namespace pl {

class BoundSession {
public:
    /// `options`: as on the command line, with '_' for '-'.
    BoundSession(const BoundScene& scene, const nb::object& learner, const nb::kwargs& options);

    /// Renders until the film has `spp` samples per pixel, for so many seconds, or down to that noise; without limits as the command
    /// line. Throws what signal handlers of Python raise, after an orderly stop.
    void render(std::optional<std::uint32_t> spp, std::optional<double> seconds, std::optional<double> target_error);

    std::uint32_t passes() const;
    NumpyArray<float> film() const;
    nb::tuple halves() const;
    nb::object statistics() const;
    BoundField field() const;
    void save(const std::filesystem::path& path) const;
    nb::bytes png() const;
    std::string text() const;

    // For the search for cycles, in which a learner that refers to its session would else stay.
    const nb::object& learner() const { return learner_; }
    void drop_learner();

private:
    /// While one lives, another thread, or a learner, is refused.
    class Use {
    public:
        explicit Use(const BoundSession& session);
        ~Use() { session_.is_used_ = false; }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

    private:
        const BoundSession& session_;
    };

    FilmSlot slot() const { return slot_of(options_.render); }
    Snapshot snapshot() const;
    Json statistics_of(const Snapshot& snapshot) const;

    BoundScene scene_;
    nb::object learner_;  ///< null without one
    Options options_;
    std::optional<Session> session_;
    RunOutcome outcome_;  ///< of the last call of render()
    std::optional<ErrorTarget> target_;
    mutable std::atomic<bool> is_used_{false};
};

}  // namespace pl
