#include "core/session/session_films.h"

namespace pl {

void SessionFilms::begin(FilmSlot slot, const FilmOrigin& before) {
    FilmOrigin& origin = (*this)[slot].origin;
    if (origin.number != 0) return;
    origin = before;
    origin.number = ++begun_;
    origin.generation = generation_;
}

void SessionFilms::clear() {
    ++generation_;
    films_.fill(FilmProgress{});
    for (ParkedBackend& parked : parked_) parked.films.fill(FilmProgress{});
}

void SessionFilms::clear(View view) {
    for (const MethodInfo& method : all_methods()) {
        const FilmSlot slot{method.id, view};
        (*this)[slot] = FilmProgress{};
        for (ParkedBackend& parked : parked_) parked.films[static_cast<std::size_t>(slot.index())] = FilmProgress{};
    }
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
