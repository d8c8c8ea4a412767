// The cost of forcing effects: passes of the picture under way are rendered in turns by the kernels with and without
// them. Both give the same bits, so the picture does not depend on the trial.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "core/measure/paired_cost.h"
#include "core/session/session.h"
#include "ui/worker/published_frame.h"

namespace pl {

class EffectTrial {
public:
    explicit EffectTrial(FeatureSet forced) : forced_(forced) {}

    /// Effects forced by the user, apart from a trial.
    FeatureSet forced() const { return forced_; }
    void set_forced(FeatureSet forced) { forced_ = forced; }

    /// Whether the cost of these effects is being measured; without effects, whether no trial runs.
    bool matches(const std::optional<FeatureSet>& wanted) const;
    /// Begins or ends a trial as requested.
    void settle(Session& session, const std::optional<FeatureSet>& wanted);

    /// Before a pass, or a part of one. Only passes of whole pictures are measured.
    void begin_pass(Session& session, FilmSlot slot, bool is_whole);
    /// Interrupted passes, and passes of another film or back end than the last one, do not count.
    void end_pass(const Session& session, FilmSlot slot, const std::string& backend, Progress progress);

    /// Empty while nothing is measured.
    std::optional<EffectTrialCost> cost() const;

private:
    struct Trial {
        FeatureSet forced;
        PairedCost cost{};
        std::array<std::string, 2> kernels{};          ///< without and with them
        std::pair<std::uint64_t, std::string> film{};  ///< number of the film, and its back end
        double seconds_before = 0.0;                   ///< of rendering the film, when the pass under way began
        bool in_pass = false;
        bool is_disturbed = false;  ///< the pass under way was interrupted
    };

    FeatureSet forced_;
    std::optional<Trial> trial_;
};

}  // namespace pl
