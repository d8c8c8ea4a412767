// Which passes of a film are guided, and which run by the baseline method: trials measure both, GuidingChoice decides.
#pragma once

#include <optional>

#include "core/session/guiding_choice.h"
#include "core/session/session_fields.h"

namespace pl {

class GuidedPasses {
public:
    GuidedPasses(const RenderInputs& inputs, SessionFields& fields) : inputs_(inputs), fields_(fields) {}

    /// Whether there is a choice. Without light samples the baseline finds light so rarely that a few passes do not show its variance.
    bool chooses(FilmSlot slot) const;
    /// Whether trials precede the first pass. Smaller pictures learn and measure by their first passes: a warm-up would cost as many.
    bool warms_up(FilmSlot slot) const;
    /// Whether the trials and passes that come next need no more than a coarse map. Views of the map show all of it.
    bool coarse_map_suffices(FilmSlot slot, const FilmProgress& film) const;
    /// Whether the first passes have more variance than later ones: where a warm-up has trained the field, only if light is hidden.
    bool first_passes_are_noisy(FilmSlot slot, const FilmProgress& film) const;
    /// Whether few passes train, because guiding does not pay.
    bool trains_rarely(const FilmProgress& film) const { return !film.guiding.pays(); }

    /// Whether choose() is due before a pass that begins.
    bool is_choice_due(FilmSlot slot, const FilmProgress& film) const;
    /// Whether the variance of the pass under way is measured.
    bool measures(FilmSlot slot, const FilmProgress& film) const {
        return chooses(slot) && film.guiding.is_measured(film.passes);
    }
    /// Decides about the passes that begin, up to the next choice. `pass`: the request for a whole one, by the method. Returns false if
    /// the trials before them were stopped: the next call resumes them.
    bool choose(FilmSlot slot, FilmProgress& film, const PassRequest& pass);
    /// Counts a pass that has ended, and measures it if it is one that decides.
    void finish_pass(FilmSlot slot, FilmProgress& film) const;

    /// See Session::guiding_status().
    std::optional<GuidingStatus> status(FilmSlot slot, const FilmProgress& film) const;

private:
    std::uint32_t trial_step() const;
    double least_ratio(FilmSlot slot) const;
    bool warm_up(FilmSlot slot, FilmProgress& film, const PassRequest& pass);
    bool run_trial(FilmProgress& film, Trial trial, const PassRequest& pass);
    bool trains_by(const FilmProgress& film, MethodId method, Trial trial) const;
    PassRequest trial_request(const FilmProgress& film, Trial trial, PassRequest request) const;

    const RenderInputs& inputs_;
    SessionFields& fields_;
};

}  // namespace pl
