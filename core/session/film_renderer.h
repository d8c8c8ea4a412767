// Renders the films of a session: which piece of work comes next, the parts of passes, and what is shown and known of each film.
#pragma once

#include "core/session/guided_passes.h"
#include "core/session/session_films.h"
#include "core/session/shown_range.h"

namespace pl {

/// Outcome of one call of Session::advance.
enum class Progress {
    Precomputed,  ///< a slice of the radiance map; the film has not changed
    Rendered,     ///< one more sample per pixel, or several
    Stopped,      ///< the stop flag was seen; the next call resumes there
};

/// A film in transfer to a window, with the range of values of its colors.
struct ShownFilm {
    DisplayFrame frame;
    ShownRange range;
};

/// Trains `fields` by its passes.
class FilmRenderer {
public:
    FilmRenderer(const RenderInputs& inputs, SessionFields& fields, std::shared_ptr<FilmNumbers> numbers)
        : inputs_(inputs), fields_(fields), guiding_(inputs, fields), films_(std::move(numbers)) {}

    /// See Session for these.
    Progress advance(FilmSlot slot, const StopFlag* stop, std::uint32_t most_passes);
    Progress advance_to_path(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop);
    ShownFilm show(FilmSlot slot, const DisplaySettings& display);
    std::optional<GuidingStatus> guiding_status(FilmSlot slot) const { return guiding_.status(slot, films_[slot]); }

    const std::shared_ptr<FilmNumbers>& numbers() const { return films_.numbers(); }
    const FilmProgress& progress(FilmSlot slot) const { return films_[slot]; }
    /// Of the passes of a film.
    PassSchedule schedule(FilmSlot slot) const;
    /// Empty before the film is allocated.
    FilmReading read(FilmSlot slot) const;
    FilmReading read_halves(FilmSlot slot) const;
    /// Whether closed surfaces surround the camera, so that escaped paths were lost. False before any has escaped.
    bool is_closed() const { return is_closed_.value_or(false); }

    /// Clears all films, see SessionFilms::clear().
    void clear();
    /// Forgets whether guiding pays, because fields are replaced or cleared.
    void forget_guiding() { films_.forget_guiding(); }

    /// See SessionFilms.
    ParkedBackend unpark(const std::shared_ptr<RenderBackend>& backend) { return films_.unpark(backend); }
    /// Continues with the films of an unparked back end, and parks the present one with its films if it `returns`.
    void switch_to(const ParkedBackend& next, bool returns);

    std::uint64_t state_bytes() const;
    void save_state(SessionState& state) const;
    void restore_state(SessionState& state);

private:
    RenderBackend& backend() const { return *inputs_.backend; }

    void begin(FilmSlot slot);
    void ensure(FilmSlot slot);
    void reset(FilmSlot slot) { backend().reset_film(slot, inputs_.settings.width, inputs_.settings.height); }
    void prepare(FilmSlot slot);
    bool needs_precompute(FilmSlot slot) const;
    Progress precompute(FilmSlot slot, const StopFlag* stop);
    std::optional<Progress> begin_pass(FilmSlot slot);
    void begin_run_if_due(FilmSlot slot);

    Progress render_passes(FilmSlot slot, const StopFlag* stop, std::uint32_t most);
    bool render_parts_before(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop);
    void render_part(FilmSlot slot, std::uint32_t end, const StopFlag* stop, std::uint32_t most_passes = 1);
    std::uint32_t end_of_part(FilmSlot slot) const;
    std::uint32_t equal_passes(FilmSlot slot, std::uint32_t most) const;
    PassRequest pass_request(FilmSlot slot, MethodId method, const StopFlag* stop) const;
    void note_escapes(FilmSlot slot, const PassCounters& counters);
    void finish_pass(FilmSlot slot);
    void finish_learning_pass(FilmSlot slot);

    const RenderInputs& inputs_;
    SessionFields& fields_;
    GuidedPasses guiding_;
    SessionFilms films_;
    std::optional<bool> is_closed_;  ///< empty before a path has escaped
};

}  // namespace pl
