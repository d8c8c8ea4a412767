// Runs as a viewer records them, on real sessions of a furnace: their identity, the times of their measurements,
// and the pictures that a limit of memory removes.
#include "core/measure/live_runs.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/scene_hash.h"
#include "tests/core/measure/recording.h"
#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

/// The time that spaces the points.
double seconds_of(const LivePoint& point) { return point.clocks.learn + point.clocks.render; }

std::size_t points_of(const LiveRunSet& set) {
    std::size_t count = 0;
    for (const auto& run : set.runs) count += run->points.size();
    return count;
}

std::size_t pictures_of(const LiveRun& run) {
    std::size_t count = 0;
    for (const LivePoint& point : run.points) count += point.picture ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("the charged time is reported while no point is due") {
    Recording recording(kPlenty, 1e-9);  // measuring may take next to nothing: none after the first passes
    recording.render(LiveRuns::kLastMeasured);
    const std::size_t points = LiveRuns::kLastMeasured - LiveRuns::kFirstMeasured + 1;
    REQUIRE(recording.last().points.size() == points);
    const double told = recording.runs.current()->charged_seconds;
    const double spent = recording.runs.current()->measure_seconds;
    while (charged_seconds(recording.session.clocks(recording.slot)) < 3.0 * told) recording.render(1);
    CHECK(recording.last().points.size() == points);
    CHECK(recording.runs.current()->charged_seconds > 2.0 * told);
    CHECK(recording.runs.current()->measure_seconds == spent);
}

TEST_CASE("the last pass is measured in any case, once") {
    Recording recording(kPlenty, 0.0);  // no budget
    recording.render(LiveRuns::kLastMeasured + 7);
    const std::size_t before = recording.last().points.size();
    CHECK_FALSE(recording.runs.is_up_to_date(recording.session, recording.slot));
    CHECK(recording.runs.observe(recording.session, recording.slot, true));
    CHECK(recording.runs.is_up_to_date(recording.session, recording.slot));
    CHECK(recording.last().points.size() == before + 1);
    CHECK(recording.last().points.back().spp == LiveRuns::kLastMeasured + 7);
    recording.runs.observe(recording.session, recording.slot, true);
    CHECK(recording.last().points.size() == before + 1);
}

TEST_CASE("each of the first passes is measured, whatever measuring costs") {
    Recording recording(kPlenty, 0.0);
    recording.render(LiveRuns::kLastMeasured + 3);
    const LiveRun& run = recording.last();
    REQUIRE(run.points.size() == 10);
    for (std::size_t i = 0; i < run.points.size(); ++i) CHECK(run.points[i].spp == i + 2);
    CHECK(recording.runs.current()->measure_seconds > 0.0);  // told, though on no budget
    // Another method begins with its own first passes.
    recording.slot.method = MethodId::Reinforcement;
    recording.render(3);
    CHECK(recording.last().points.size() == 2);
}

TEST_CASE("a film that another one replaces leaves its number of passes, measured or not") {
    Recording recording(kPlenty, 0.0);
    recording.render(LiveRuns::kLastMeasured + 7);
    CHECK(recording.last().points.back().spp == LiveRuns::kLastMeasured);
    CHECK(recording.last().passes == LiveRuns::kLastMeasured);
    recording.slot.method = kLearner;
    recording.render(1);
    CHECK(recording.run(0).passes == LiveRuns::kLastMeasured + 7);
    CHECK_FALSE(is_old(2, 3));
    CHECK_FALSE(is_old(40, 51));
    CHECK(is_old(40, 52));
}

TEST_CASE("points are a twelfth of a decade apart and hold cost, noise and picture") {
    Recording recording;
    CHECK(recording.runs.current()->runs.empty());
    CHECK(recording.runs.current()->picture_bytes_cap == kPlenty);
    CHECK(recording.render(1) == 0);  // one sample has no halves
    CHECK(recording.render(1) == 1);
    recording.record(14);
    REQUIRE(recording.count() == 1);
    const LiveRun& run = recording.run(0);
    CHECK(run.in_progress);
    CHECK(run.label.method == MethodId::Default);
    CHECK(run.label.backend == "cpu");
    CHECK_FALSE(run.label.warm);
    CHECK(run.label.picture == picture_key(scene_hash(recording.scene), recording.session.settings()));
    REQUIRE(run.points.size() == 15);
    for (std::size_t i = 10; i < run.points.size(); ++i)
        CHECK(seconds_of(run.points[i]) >= std::pow(10.0, 1.0 / 12.0) * seconds_of(run.points[i - 1]));
    const LivePoint& point = run.points.back();
    CHECK(point.counters.paths == std::uint64_t{point.spp} * kSide * kSide);
    CHECK_FALSE(point.metrics);
    // The furnace's noise is known from its truth; 256 pixels of alike channels leave sqrt(2/256) = 9 % on each.
    std::vector<Vec3f> picture = pixels_of(*point.picture);
    const Metrics error = measure_error(picture, recording.truth()->first);
    CHECK_THAT(point.noise, WithinRel(error.relmse, 0.6));
    CHECK(recording.runs.current()->picture_bytes == kPictureBytes * run.points.size());
    CHECK(recording.runs.current()->measure_seconds > 0.0);
}

TEST_CASE("a set that was handed out never changes") {
    Recording recording;
    recording.render(4);
    const auto before = recording.runs.current();
    const std::size_t points = before->runs.at(0)->points.size();
    recording.record(2);
    CHECK(before->runs.at(0)->points.size() == points);
    CHECK(recording.run(0).points.size() > points);
}

TEST_CASE("another method is another run, and the way back goes on with the first one") {
    Recording recording;
    recording.record(2);
    recording.slot.method = MethodId::Reinforcement;
    recording.record(2);
    REQUIRE(recording.count() == 2);
    CHECK_FALSE(recording.run(0).in_progress);
    CHECK(recording.run(1).in_progress);
    CHECK(recording.run(1).label.method == MethodId::Reinforcement);
    CHECK_FALSE(recording.run(1).label.warm);
    CHECK(recording.run(1).points.front().clocks.place > 0.0);
    CHECK(recording.run(0).points.front().clocks.place == 0.0);
    const std::size_t points = recording.run(0).points.size();
    recording.slot.method = MethodId::Default;
    recording.record(2);
    REQUIRE(recording.count() == 2);
    CHECK(recording.run(0).in_progress);
    CHECK(recording.run(0).points.size() > points);
    // The cost of the other method is not charged here.
    CHECK(recording.run(0).points.back().clocks.place == 0.0);
}

TEST_CASE("a restart begins a new run, a warm one where something was learned, and the old one stays") {
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed, MethodId::Reinforcement}) {
        INFO(info_of(method).name);
        const bool learns = info_of(method).uses_field;
        Recording recording(kPlenty, kAlways, method);
        recording.record(3);
        recording.session.apply(EditRestart{});
        recording.record(3);
        REQUIRE(recording.count() == 2);
        CHECK_FALSE(recording.run(0).label.warm);
        CHECK(recording.run(1).label.warm == learns);
        CHECK(recording.run(0).number < recording.run(1).number);
        CHECK(recording.run(0).points.size() > 1);
        CHECK_FALSE(recording.run(0).in_progress);
        if (learns) CHECK(recording.run(0).points.front().clocks.place > 0.0);
        // A warm run is not charged for the field that it began with.
        CHECK(recording.run(1).points.front().clocks.place == 0.0);
        CHECK(recording.run(1).points.front().clocks.precompute == 0.0);
        recording.session.apply(EditForget{});
        recording.record(3);
        CHECK_FALSE(recording.last().label.warm);
    }
}

TEST_CASE("another camera or size is another picture, and runs that hardly began are forgotten") {
    Recording recording;
    recording.record(3);
    CameraDescription camera = recording.session.settings().camera;
    for (int i = 0; i < 5; ++i) {  // a drag: a sample or two from each camera
        camera.eye.x += 0.01f;
        recording.session.apply(EditCamera{camera});
        recording.render(2);
    }
    recording.record(3);
    REQUIRE(recording.count() == 2);
    CHECK(recording.run(0).label.picture != recording.run(1).label.picture);
    recording.session.apply(EditSize{kSide, kSide / 2});
    recording.record(3);
    REQUIRE(recording.count() == 3);
    CHECK(recording.last().label.picture != recording.run(1).label.picture);
    CHECK(recording.last().points.front().picture->height == kSide / 2);
}

TEST_CASE(
    "another back end is another run, warm with what moves along, and the way back goes on with the first one") {
    const SceneDescription scene = furnace_scene(kEmission, kAlbedo);
    const std::shared_ptr<RenderBackend> first = make_cpu_backend({.threads = 1});
    const std::shared_ptr<RenderBackend> second = make_cpu_backend({.threads = 1});
    Session session(first, std::make_shared<const SceneDescription>(scene),
                    quick_learner(scene, {MethodId::Reinforcement, false}, kSide, 1));
    CHECK(session.clocks(slot_of(session)).upload > 0.0);
    LiveRuns runs(kPlenty, {}, kAlways);
    const auto render_on = [&](const std::shared_ptr<RenderBackend>& backend) {
        session.apply(EditBackend{.backend = backend});
        for (int points = 0; points < 3;) {
            session.advance(slot_of(session));
            const std::size_t before = points_of(*runs.current());
            runs.observe(session, slot_of(session));
            points += points_of(*runs.current()) > before ? 1 : 0;
        }
        return runs.current();
    };
    const auto one = render_on(first);
    REQUIRE(one->runs.size() == 1);
    const auto two = render_on(second);
    REQUIRE(two->runs.size() == 2);
    CHECK_FALSE(two->runs[0]->label.warm);
    CHECK(two->runs[1]->label.warm);
    CHECK_FALSE(two->runs[0]->in_progress);
    CHECK(two->runs[1]->in_progress);
    const auto back = render_on(first);
    CHECK(back->runs.size() == 2);
    CHECK(back->runs[0]->in_progress);
    CHECK(back->runs[0]->points.back().spp > one->runs[0]->points.back().spp);
}

TEST_CASE("two sessions side by side are followed as one, also through a camera move that both make") {
    Recording recording;
    RenderSettings settings = recording.session.settings();
    settings.roulette = RouletteRule::Albedo;
    Session second(recording.session, make_cpu_backend({.threads = 1}), settings);
    CHECK(second.packed_scene() == recording.session.packed_scene());
    const auto render_both = [&](int passes) {
        for (int i = 0; i < passes; ++i) {
            recording.render(1);
            second.advance(recording.slot);
            recording.runs.observe(second, recording.slot);
        }
    };
    render_both(4);
    REQUIRE(recording.count() == 2);
    CHECK(recording.run(0).number != recording.run(1).number);
    CHECK(recording.run(0).points.size() == recording.run(1).points.size());
    CHECK(recording.run(1).settings.roulette == RouletteRule::Albedo);
    CHECK(recording.run(0).settings.roulette == recording.session.settings().roulette);
    CHECK(recording.session.film_origin(recording.slot).generation == second.film_origin(recording.slot).generation);
    CameraDescription camera = settings.camera;
    camera.eye.x += 0.01f;
    recording.session.apply(EditCamera{camera});
    second.apply(EditCamera{camera});
    render_both(4);
    REQUIRE(recording.count() == 4);
    CHECK(recording.run(2).label.picture == recording.run(3).label.picture);
    CHECK(recording.run(3).points.size() > 1);
}

TEST_CASE("other views are not measured, and interrupt no run") {
    Recording recording;
    recording.record(2);
    const std::size_t points = recording.run(0).points.size();
    recording.slot.view = View::Normal;
    recording.render(50);
    CHECK(recording.count() == 1);
    CHECK(recording.run(0).points.size() == points);
    CHECK_FALSE(recording.run(0).in_progress);
    recording.slot.view = View::Beauty;
    recording.record(2);
    CHECK(recording.count() == 1);
    CHECK(recording.run(0).in_progress);
    CHECK(recording.run(0).points.size() > points);
}

TEST_CASE("errors are measured against the reference of the same picture, in the past too, and against no other") {
    Recording recording;
    recording.record(3);
    const auto wrong = recording.truth();
    wrong->picture += 1;
    recording.runs.set_reference(wrong);
    recording.record(3);
    for (const LivePoint& point : recording.run(0).points) CHECK_FALSE(point.metrics);

    recording.runs.set_reference(recording.truth());
    const std::size_t past = recording.run(0).points.size();
    for (const LivePoint& point : recording.run(0).points) {
        REQUIRE(point.metrics);
        CHECK_FALSE(point.squared_bias);
        CHECK_THAT(point.metrics->relmse,
                   WithinRel(measure_error(pixels_of(*point.picture), recording.truth()->first).relmse, 1e-12));
    }
    recording.record(2);
    REQUIRE(recording.run(0).points.size() > past);
    const LivePoint& last = recording.run(0).points.back();
    REQUIRE(last.metrics);
    REQUIRE(last.signed_bias);
    CHECK(last.squared_bias);
    // Half floats below 2 are off by at most 2^-11, and so is the root of the mean square (triangle inequality).
    const double from_halves = measure_error(pixels_of(*last.picture), recording.truth()->first).relmse;
    CHECK_THAT(std::sqrt(from_halves), WithinAbs(std::sqrt(last.metrics->relmse), std::ldexp(1.0, -11)));

    CameraDescription camera = recording.session.settings().camera;
    camera.eye.x += 0.1f;
    recording.session.apply(EditCamera{camera});
    recording.record(3);
    for (const LivePoint& point : recording.last().points) CHECK_FALSE(point.metrics);

    recording.runs.set_reference(nullptr);
    CHECK(recording.run(0).points.back().metrics);  // measured metrics stay
    auto broken = recording.truth();
    broken->second.pop_back();
    CHECK_THROWS_AS(recording.runs.set_reference(broken), Error);
}

TEST_CASE("pictures keep within their memory, the figures stay") {
    constexpr std::size_t kRoom = 5;
    Recording recording(kRoom * kPictureBytes + kPictureBytes / 2);
    recording.record(kRoom + 7);
    CHECK(pictures_of(recording.run(0)) == kRoom);
    CHECK(recording.runs.current()->picture_bytes == kRoom * kPictureBytes);
    CHECK(recording.run(0).points.back().picture != nullptr);
    // Those that stay are spread over the run: in log time, no gap is much longer than the mean one and the longest one that
    // there was when all were there.
    std::vector<double> all, kept;
    for (const LivePoint& point : recording.run(0).points) {
        all.push_back(std::log(seconds_of(point)));
        if (point.picture) kept.push_back(all.back());
    }
    double longest = 0.0;
    for (std::size_t i = 1; i < all.size(); ++i) longest = std::max(longest, all[i] - all[i - 1]);
    const double mean = (all.back() - all.front()) / kRoom;
    for (std::size_t i = 1; i < kept.size(); ++i) CHECK(kept[i] - kept[i - 1] < longest + 2.0 * mean);

    // Another method of the same picture shares the memory, one of another picture takes it over.
    recording.slot.method = MethodId::Reinforcement;
    recording.record(3);
    CHECK(pictures_of(recording.run(0)) > 0);
    CHECK(pictures_of(recording.run(1)) > 0);
    CameraDescription camera = recording.session.settings().camera;
    camera.eye.x += 0.1f;
    recording.session.apply(EditCamera{camera});
    recording.record(kRoom + 2);
    CHECK(pictures_of(recording.run(0)) == 0);
    CHECK(pictures_of(recording.run(1)) == 0);
    CHECK(pictures_of(recording.last()) == kRoom);
    CHECK(recording.run(0).points.size() > kRoom);

    Recording none(0);
    none.record(2);
    CHECK(none.runs.current()->picture_bytes == 0);
}

TEST_CASE("a run that is forgotten while it renders begins anew") {
    Recording recording;
    recording.render(100);
    const std::uint64_t number = recording.run(0).number;
    recording.runs.forget(number);
    CHECK(recording.count() == 0);
    recording.runs.forget(number);
    recording.render(1);
    REQUIRE(recording.count() == 1);
    CHECK(recording.run(0).number == number);
    CHECK(recording.run(0).points.front().spp == 101);
    recording.runs.forget(number);
    CHECK(recording.count() == 0);
    CHECK(recording.runs.current()->picture_bytes == 0);
}

TEST_CASE("words for other settings are those of the newest point") {
    const SceneDescription scene = furnace_scene(kEmission, kAlbedo);
    Session session = make_session(scene, quick_learner(scene, {MethodId::Default, true}, kSide, 1));
    int asked = 0;
    LiveRuns runs(
        kPlenty,
        [&](const Session& s, FilmSlot slot) {
            ++asked;
            return s.passes(slot) < 20 ? std::string("as begun")
                                       : "--max-depth " + std::to_string(s.settings().max_depth);
        },
        kAlways);
    const auto newest_spp = [&] {
        const auto set = runs.current();
        return set->runs.empty() ? 0u : set->runs.front()->points.back().spp;
    };
    while (newest_spp() < 20) {
        session.advance(slot_of(session));
        runs.observe(session, slot_of(session));
    }
    CHECK(asked == static_cast<int>(runs.current()->runs.at(0)->points.size()));
    CHECK(runs.current()->runs.at(0)->label.details == "--max-depth 64");
    CHECK(runs.current()->runs.at(0)->label.next_event);
}

}  // namespace pl::test
