#include "core/session/session_films.h"

#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr FilmSlot kPicture{MethodId::Reinforcement, View::Beauty};
constexpr FilmSlot kCells{MethodId::Reinforcement, View::Voronoi};

}  // namespace

TEST_CASE("Session films: an origin is given once, and anew after all films were emptied") {
    SessionFilms films;
    films.begin(kPicture, {.warm = true, .place_seconds = 2.0});
    CHECK(films[kPicture].origin.number == 1);
    CHECK(films[kPicture].origin.warm);
    films.begin(kPicture, {.warm = false});
    CHECK(films[kPicture].origin.number == 1);
    CHECK(films[kPicture].origin.place_seconds == 2.0);
    films.begin(kCells, {});
    CHECK(films[kCells].origin.number == 2);
    const std::uint64_t generation = films[kPicture].origin.generation;
    films.clear();
    CHECK(films[kPicture].origin.number == 0);
    films.begin(kPicture, {});
    CHECK(films[kPicture].origin.number == 3);
    CHECK(films[kPicture].origin.generation > generation);
}

TEST_CASE("Session films: parked films return with their back end, emptied like the others meanwhile") {
    const std::shared_ptr<RenderBackend> first = make_cpu_backend({.threads = 1});
    const auto scene = std::make_shared<const HostScene>();
    SessionFilms films;
    films[kPicture].passes = 5;
    films[kCells].passes = 3;
    films.park(first, scene);
    films.resume(films.unpark(nullptr));
    CHECK(films[kPicture].passes == 0);
    films.clear(View::Voronoi);
    const ParkedBackend back = films.unpark(first);
    CHECK(back.backend == first);
    CHECK(back.scene == scene);
    films.resume(back);
    CHECK(films[kPicture].passes == 5);
    CHECK(films[kCells].passes == 0);
    CHECK_FALSE(films.unpark(first).scene);  // taken once
    films.park(first, scene);
    films.clear();
    CHECK(films.unpark(first).films[static_cast<std::size_t>(kPicture.index())].passes == 0);
}
