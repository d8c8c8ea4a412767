#include "core/session/session_films.h"

#include <algorithm>

namespace pl {
namespace {

void clear_film(FilmProgress& film) { film = FilmProgress{.guiding = film.guiding.restarted()}; }

}  // namespace

void SessionFilms::begin(FilmSlot slot, const FilmOrigin& before) {
    FilmOrigin& origin = (*this)[slot].origin;
    if (origin.number != 0) return;
    origin = before;
    origin.number = ++numbers_->begun;
    origin.generation = numbers_->generation;
}

void SessionFilms::clear() {
    ++numbers_->generation;
    std::ranges::for_each(films_, clear_film);
    for (ParkedBackend& parked : parked_) std::ranges::for_each(parked.films, clear_film);
}

void SessionFilms::forget_guiding() {
    for (FilmProgress& film : films_) film.guiding = {};
    for (ParkedBackend& parked : parked_)
        for (FilmProgress& film : parked.films) film.guiding = {};
}

void SessionFilms::clear(View view) {
    for (const MethodInfo& method : all_methods()) {
        const FilmSlot slot{method.id, view};
        clear_film((*this)[slot]);
        for (ParkedBackend& parked : parked_) clear_film(parked.films[static_cast<std::size_t>(slot.index())]);
    }
}

void SessionFilms::restore(FilmSlot slot, FilmProgress progress) {
    numbers_->begun = std::max(numbers_->begun, progress.origin.number);
    numbers_->generation = std::max(numbers_->generation, progress.origin.generation);
    (*this)[slot] = std::move(progress);
}

void SessionFilms::park(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const HostScene> scene) {
    parked_.push_back({std::move(backend), films_, std::move(scene)});
}

ParkedBackend SessionFilms::unpark(const std::shared_ptr<RenderBackend>& backend) {
    ParkedBackend result{.backend = backend, .films = {}, .scene = nullptr};
    for (const ParkedBackend& parked : parked_)
        if (parked.backend == backend) result = parked;
    std::erase_if(parked_, [&](const ParkedBackend& parked) { return parked.backend == backend; });
    return result;
}

}  // namespace pl
