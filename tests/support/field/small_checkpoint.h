// The smallest checkpoint with a part of every kind, for tests of files.
#pragma once

#include <utility>

#include "core/io/checkpoint_file.h"
#include "tests/support/field/small_field.h"

namespace pl::test {

/// Two films, one of them within a pass, and the smallest field.
inline Checkpoint small_checkpoint() {
    const LearnedField learned = small_field();
    SessionState state{.identity = {{"scene hash", "abc"}, {"seed", "1"}},
                       .placement = {},
                       .fields = {},
                       .films = {},
                       .is_closed = true};
    state.placement = SavedPlacement{.settings = learned.settings,
                                     .shape = learned.shape,
                                     .refinement = {.rounds = 2, .added = 1},
                                     .seconds = 0.25,
                                     .volumes = learned.volumes};
    state.fields.push_back({.method = learned.method, .progress = learned.progress, .arrays = learned.field});
    state.fields[0].progress.precompute_seconds = 0.3;
    state.fields[0].progress.forgotten = {0};
    state.films.resize(2);
    state.films[1].slot = {MethodId::Default, View::Beauty};
    SavedFilm& film = state.films[0];
    film.slot = {learned.method, View::Beauty};
    film.pixels.resize(6);
    film.progress.is_allocated = true;
    film.progress.passes = 3;
    film.progress.next_pixel = 2;
    film.progress.runs = {{}, {1, 5, {10, 5}, false, false}, {3, 7, {14, 7}, true, true}};
    film.progress.updates_seen = 4;
    film.progress.counters.path.method.lookup_misses = 77;
    film.progress.counters.variance = {5, 6};
    film.progress.guiding.begin_film(6, false);
    film.pixels[4].second_sum = Vec3d{0.1, 0.2, 1.0e300};
    film.pixels[5].emission = {.value = 9, .varies = 3, .at_border = 1};
    return {.seconds = 12.5, .state = std::move(state)};
}

}  // namespace pl::test
