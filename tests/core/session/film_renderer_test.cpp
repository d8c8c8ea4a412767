// The films of a session on fields of its own: which pieces of work follow each other, and what clearing and parking leaves.
#include "core/session/film_renderer.h"

#include "tests/core/session/stopping_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FilmSlot kDefault{MethodId::Default, View::Beauty};
constexpr FilmSlot kVisits{MethodId::Reinforcement, View::Visits};
constexpr FilmSlot kMapped{MethodId::Precomputed, View::Beauty};

struct Films {
    std::shared_ptr<StoppingBackend> backend = std::make_shared<StoppingBackend>();
    RenderInputs inputs;
    SessionFields fields{inputs};
    FilmRenderer films{inputs, fields, std::make_shared<FilmNumbers>()};

    explicit Films(const std::string& scene = "door")
        : inputs{.backend = backend,
                 .settings = {},
                 .scene = SessionScene(std::make_shared<const SceneDescription>(shipped_scene(scene)))} {
        inputs.settings = small_settings(*inputs.scene.description(), {MethodId::Default, true});
        backend->upload_scene(inputs.scene.packed());
    }
    Films(const Films&) = delete;
    Films& operator=(const Films&) = delete;

    Progress advance(FilmSlot slot) { return films.advance(slot, nullptr, 1); }
    void render(FilmSlot slot, std::uint32_t passes) {
        while (films.progress(slot).passes < passes) REQUIRE(advance(slot) == Progress::Rendered);
    }
};

}  // namespace

TEST_CASE("Film renderer: a film of a method without a field places no volumes") {
    Films made;
    made.render(kDefault, 5);
    CHECK(made.films.progress(kDefault).counters.paths == 5 * std::uint64_t{made.inputs.pixel_count()});
    CHECK_FALSE(made.fields.placement().is_placed());
    CHECK(made.films.read(kDefault).width == made.inputs.settings.width);
    CHECK(made.films.read(kLearningFilm).mean.empty());  // no film was allocated for it
}

TEST_CASE("Film renderer: a map is filled before its first pass") {
    Films made;
    for (int slice = 0; slice < 4; ++slice) CHECK(made.advance(kMapped) == Progress::Precomputed);
    CHECK(made.fields.is_map_complete(kMapped.method));
    CHECK(made.films.progress(kMapped).passes == 0);
    CHECK(made.advance(kMapped) == Progress::Rendered);
}

TEST_CASE("Film renderer: a pass of a view of what is learned follows one that learns") {
    Films made;
    CHECK(made.advance(kVisits) == Progress::Rendered);
    CHECK(made.films.progress(kVisits).passes == 1);
    CHECK(made.films.progress(kLearningFilm).passes == 1);
    CHECK(made.fields.trained_passes(kLearningFilm.method) == 1);
    CHECK_FALSE(made.films.progress(kVisits).origin.warm);
}

TEST_CASE("Film renderer: a pass that was stopped goes on where it was, and is forgotten by clearing") {
    Films made;
    made.backend->stops_behind = 100;
    CHECK(made.advance(kDefault) == Progress::Stopped);
    CHECK(made.films.progress(kDefault).next_pixel == 100);
    CHECK(made.advance(kDefault) == Progress::Rendered);
    CHECK_FALSE(made.films.progress(kDefault).is_under_way());
    made.backend->stops_behind = 100;
    CHECK(made.advance(kDefault) == Progress::Stopped);
    made.films.clear();
    CHECK(made.films.progress(kDefault).passes == 0);
    CHECK_FALSE(made.films.progress(kDefault).is_under_way());
}

TEST_CASE(
    "Film renderer: whether escaped paths were lost is known from the first that escapes until films are cleared") {
    Films made("cornell");
    made.inputs.backend = make_cpu_backend({.threads = 1});
    made.inputs.backend->upload_scene(made.inputs.scene.packed());
    CHECK_FALSE(made.films.is_closed());
    SessionState state{.identity = {}, .placement = {}, .fields = {}, .films = {}, .is_closed = true};
    made.films.restore_state(state);
    CHECK(made.films.is_closed());
    made.advance(kDefault);
    REQUIRE(made.films.progress(kDefault).counters.path.escaped > 0);
    CHECK(made.films.is_closed());  // tested once
    made.films.clear();
    CHECK_FALSE(made.films.is_closed());
    made.advance(kDefault);
    state = {.identity = {}, .placement = {}, .fields = {}, .films = {}, .is_closed = {}};
    made.films.save_state(state);
    CHECK(state.is_closed == false);
}

TEST_CASE("Film renderer: films wait with their back end") {
    Films made;
    made.render(kDefault, 3);
    const auto first = made.backend;
    const auto switch_to = [&](std::shared_ptr<RenderBackend> backend) {
        made.films.switch_to(made.films.unpark(backend), true);
        made.inputs.backend = std::move(backend);
    };
    const std::shared_ptr<RenderBackend> second = make_cpu_backend({.threads = 1});
    second->upload_scene(made.inputs.scene.packed());
    switch_to(second);
    CHECK(made.films.progress(kDefault).passes == 0);
    made.advance(kDefault);
    switch_to(first);
    CHECK(made.films.progress(kDefault).passes == 3);
    made.films.switch_to(made.films.unpark(second), false);
    CHECK(made.films.progress(kDefault).passes == 1);
    CHECK(made.films.unpark(first).scene == nullptr);  // was not parked
}
