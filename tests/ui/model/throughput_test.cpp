#include "tests/support/catch.hpp"
#include "ui/model/throughput.h"

using namespace pl;
using namespace pl::ui;

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
