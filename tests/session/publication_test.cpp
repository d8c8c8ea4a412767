// When what passes recorded becomes the tables of the next ones, and what becomes of records that wait.
#include "core/session/publication_times.h"

#include <algorithm>
#include <numeric>

#include "core/io/field_file.h"
#include "tests/catch.hpp"
#include "tests/io/temporary_folder.h"
#include "tests/session/same_bits.h"
#include "tests/session/small_settings.h"
#include "tests/statistical/shipped_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr Estimator kLearning{MethodId::Reinforcement, false};

template <class T, class Allocator>
std::uint64_t sum(const std::vector<T, Allocator>& values) {
    return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

std::uint64_t waiting_records(const Session& session) { return sum(session.export_field().tables.pending_count); }

}  // namespace

TEST_CASE(
    "Tables are published after the first sixteen passes, then after every eighth of all, at last every sixteenth") {
    std::uint32_t last = 0;
    for (std::uint32_t passes = 1; passes <= 4096; ++passes) {
        if (!is_published_after(passes)) continue;
        const std::uint32_t since = passes - last;
        INFO(passes << " passes, " << since << " since the last publication");
        CHECK((passes > 16 || since == 1));
        CHECK(since <= std::max(1u, passes / 8));
        CHECK(since <= kMostPassesUnpublished);
        CHECK((since >= passes / 16 || since == kMostPassesUnpublished));
        last = passes;
    }
    CHECK(last == 4096);
    CHECK(is_published_after(0xfffffff0u));
}

TEST_CASE("Records wait in their sums until tables are published, and none is lost") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, kLearning), 2);
    for (std::uint32_t pass = 1; pass <= 20; ++pass) {
        render_passes(session, 1);
        INFO("after pass " << pass);
        const std::uint64_t waiting = waiting_records(session);
        CHECK((waiting == 0) == is_published_after(pass));
        CHECK(sum(session.export_field().tables.visits) + waiting == session.field_status()->records);
    }
}

TEST_CASE("A picture that begins anew is learned from after its first pass, with what had waited") {
    const SceneDescription scene = shipped_scene("door");
    Session session = make_session(scene, small_settings(scene, kLearning), 2);
    render_passes(session, 17);
    REQUIRE(waiting_records(session) > 0);
    session.apply(EditRestart{});
    render_passes(session, 1);
    CHECK(waiting_records(session) == 0);
    CHECK(sum(session.export_field().tables.visits) == session.field_status()->records);
}

TEST_CASE("Records that wait are saved and loaded with the tables") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, kLearning);
    Session first = make_session(scene, settings, 2);
    render_passes(first, 17);
    const LearnedField field = first.export_field();
    REQUIRE(sum(field.tables.pending_count) > 0);
    const TemporaryFolder folder;
    write_field(folder.path() / "field", field);

    Session second = make_session(scene, settings, 1);
    second.import_field(read_field(folder.path() / "field"));
    CHECK(waiting_records(second) == sum(field.tables.pending_count));
    first.apply(EditRestart{});
    render_passes(first, 2);
    render_passes(second, 2);
    CHECK(same_state(state_of(first), state_of(second)));
}
