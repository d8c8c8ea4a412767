// Which passes of a film are guided, and which run by the baseline method, as GuidingChoice decides.
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
    /// Whether the passes that come next need no more than a coarse map. Views of the map show all of it.
    bool coarse_map_suffices(FilmSlot slot, const FilmProgress& film) const;

    /// Before the first pass.
    void begin_film(FilmSlot slot, FilmProgress& film) const;
    /// Decides about a pass that begins.
    void begin_pass(FilmSlot slot, FilmProgress& film) const;
    /// The role of a pass in the choice, if there is one.
    PassRole role_of(FilmSlot slot, const FilmProgress& film, std::uint32_t pass) const {
        return chooses(slot) ? film.guiding.role_of(pass) : PassRole::None;
    }
    /// Makes a request for the pass under way to what the choice says, from one by the method.
    void shape(FilmSlot slot, const FilmProgress& film, PassRequest& request) const;
    /// Counts a pass that has ended, and measures it if it is one that decides.
    void finish_pass(FilmSlot slot, FilmProgress& film) const;

    /// See Session::guiding_status().
    std::optional<GuidingStatus> status(FilmSlot slot, const FilmProgress& film) const;

private:
    const RenderInputs& inputs_;
    SessionFields& fields_;
};

}  // namespace pl
