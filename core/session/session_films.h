// The films of a session by method and view: their progress and origin, and the films of back ends that wait.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/session/backend.h"
#include "core/session/guiding_choice.h"
#include "core/session/pass_replay.h"
#include "core/session/snapshot.h"

namespace pl {

/// Progress of one film.
struct FilmProgress {
    FilmOrigin origin{};
    bool is_allocated = false;
    std::uint32_t passes = 0;      ///< complete
    std::uint32_t next_pixel = 0;  ///< number of pixels that the running pass has rendered
    PassCounters counters{};
    double render_seconds = 0.0;
    double guided_seconds = 0.0;  ///< of these, by guided passes
    double learn_seconds = 0.0;

    GuidingChoice guiding{};
    bool is_guided = true;    ///< the pass under way, or the last one; also for methods without a field
    bool trains = false;      ///< the pass under way, or the last one, trains the field
    PassCounters measured{};  ///< since the pass under way began
    std::uint32_t unguided_passes = 0;
    std::vector<PassRun> runs{};     ///< of all passes, the one under way included
    std::uint64_t updates_seen = 0;  ///< FieldProgress::updates at the beginning of the last run

    /// Whether a pass has rendered some of its pixels.
    bool is_under_way() const { return next_pixel > 0; }
};

/// A back end that is not in use, with its films and the scene uploaded to it.
struct ParkedBackend {
    std::shared_ptr<RenderBackend> backend;
    std::array<FilmProgress, FilmSlot::kCount> films{};
    std::shared_ptr<const HostScene> scene;
};

/// Counts what a session and those made beside it begin and empty.
struct FilmNumbers {
    std::uint64_t begun = 0;       ///< films
    std::uint64_t generation = 0;  ///< number of SessionFilms::clear() so far
};

/// The films of the back end in use, and of parked back ends.
class SessionFilms {
public:
    explicit SessionFilms(std::shared_ptr<FilmNumbers> numbers = std::make_shared<FilmNumbers>())
        : numbers_(std::move(numbers)) {}

    const std::shared_ptr<FilmNumbers>& numbers() const { return numbers_; }

    FilmProgress& operator[](FilmSlot slot) { return films_[static_cast<std::size_t>(slot.index())]; }
    const FilmProgress& operator[](FilmSlot slot) const { return films_[static_cast<std::size_t>(slot.index())]; }

    /// Gives a film its origin before the first work on it, precomputation included. `before`: state at that moment,
    /// whether the field is warm, and seconds on the clocks.
    void begin(FilmSlot slot, const FilmOrigin& before);
    /// Clears all films, of parked back ends as well. What was measured about guiding is kept.
    void clear();
    /// Forgets whether guiding pays, because fields are replaced or cleared.
    void forget_guiding();
    /// Clears the films of one view, of all methods.
    void clear(View view);

    /// Puts back the progress of a film; later films are numbered after it.
    void restore(FilmSlot slot, FilmProgress progress);

    /// Keeps the films of this back end for its return.
    void park(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const HostScene> scene);
    /// Takes out a parked back end; without films and scene if it is not parked.
    ParkedBackend unpark(const std::shared_ptr<RenderBackend>& backend);
    /// Continues with the films of an unparked back end.
    void resume(const ParkedBackend& backend) { films_ = backend.films; }

private:
    std::array<FilmProgress, FilmSlot::kCount> films_{};
    std::vector<ParkedBackend> parked_;
    std::shared_ptr<FilmNumbers> numbers_;
};

}  // namespace pl
