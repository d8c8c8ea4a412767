// The window's interface to the render thread, over fake back ends.
#include "ui/model/render_link.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

Snapshot snapshot_of(std::uint64_t paths, double seconds) {
    Snapshot snapshot;
    snapshot.counters.paths = paths;
    snapshot.clocks.render = seconds;
    return snapshot;
}

}  // namespace

TEST_CASE("Throughput: paths per second of the render clock, over half a second at least") {
    Throughput throughput;
    CHECK(throughput.mpaths_per_second() == 0.0);
    throughput.observe(snapshot_of(1000000, 0.1), "cpu");
    CHECK(throughput.mpaths_per_second() == Approx(10.0));
    throughput.observe(snapshot_of(2000000, 0.5), "cpu");  // too soon
    CHECK(throughput.mpaths_per_second() == Approx(10.0));
    throughput.observe(snapshot_of(4000000, 0.7), "cpu");
    CHECK(throughput.mpaths_per_second() == Approx(5.0));
}

TEST_CASE("Throughput: another back end and a cleared film start over") {
    Throughput throughput;
    throughput.observe(snapshot_of(1000000, 1.0), "cpu");
    throughput.observe(snapshot_of(4000000, 2.0), "cuda");
    CHECK(throughput.mpaths_per_second() == Approx(2.0));
    throughput.observe(snapshot_of(1000000, 0.25), "cuda");
    CHECK(throughput.mpaths_per_second() == Approx(4.0));
    throughput.observe(snapshot_of(1000000, 0.25), "cuda");  // no time has passed
    CHECK(throughput.mpaths_per_second() == Approx(4.0));
}

namespace {

template <class Condition>
bool run_until(RenderLink& link, Condition&& condition) {
    return eventually([&] {
        link.update();
        return condition();
    });
}

}  // namespace

TEST_CASE("Render link: rendering rests until no reason holds it") {
    using Hold = RenderLink::Hold;
    Bench bench;
    RenderLink link(bench.setup());
    REQUIRE(run_until(link, [&] { return link.frame() != nullptr; }));
    link.hold(Hold::User, true);
    link.hold(Hold::Reference, true);
    REQUIRE(run_until(link, [&] { return link.status().state == WorkerState::Paused; }));
    link.hold(Hold::User, false);
    CHECK_FALSE(link.is_held(Hold::User));
    CHECK(link.is_held(Hold::Reference));
    const std::uint32_t passes = link.status().passes;
    link.update();
    CHECK(link.status().passes == passes);
    link.hold(Hold::Reference, false);
    CHECK(run_until(link, [&] { return link.status().passes > passes; }));
}

TEST_CASE("Render link: in turns each method has its newest frame") {
    Bench bench;
    bench.control->pass_microseconds = 1000;
    RenderLink link(bench.setup(MethodId::Reinforcement));
    REQUIRE(run_until(link, [&] { return link.frame() != nullptr; }));
    CHECK(link.throughput().mpaths_per_second() > 0.0);
    link.begin_turns({MethodId::Reinforcement, MethodId::Default});
    REQUIRE(run_until(link, [&] { return link.second_frame() != nullptr; }));
    CHECK(link.frame()->snapshot.slot.method == MethodId::Reinforcement);
    CHECK(link.second_frame()->snapshot.slot.method == MethodId::Default);
    link.end_turns(MethodId::Reinforcement);
    CHECK_FALSE(link.turns().has_value());
    CHECK(link.second_frame() == nullptr);
}
