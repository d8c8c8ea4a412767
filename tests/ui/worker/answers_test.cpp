#include "ui/worker/answers.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Answers: a surface under the image with its volume, or none") {
    SessionBench bench(64);
    const PickAnswer hit = answer_pick(bench.session, {0.5f, 0.65f});
    REQUIRE(hit.value);
    CHECK(hit.value->volume != kNoVolume);
    CHECK_FALSE(answer_pick(bench.session, {0.01f, 0.01f}).value);
}

TEST_CASE("Answers: a field of the method, or the reason why there is none") {
    SessionBench bench;
    CHECK_THAT(answer_learned(bench.session, MethodId::Reinforcement).reason, contains("has learned nothing yet"));
    bench.render(kLearning, 2);
    const LearnedAnswer answer = answer_learned(bench.session, MethodId::Reinforcement);
    REQUIRE(answer.value);
    CHECK(answer.value->progress.passes == 2);
    CHECK_FALSE(answer_learned(bench.session, MethodId::Default).value);
}

TEST_CASE("Answers: diagnostics of a picture, or the reason why it has none") {
    SessionBench bench;
    bench.render(kDefault, 2);
    const DiagnosticsAnswer answer = answer_diagnostics(bench.session, kDefault, 5);
    REQUIRE(answer.value);
    CHECK(answer.value->passes.samples == 2);
    CHECK(answer.generation == 5);
    CHECK_THAT(answer_diagnostics(bench.session, {MethodId::Default, View::Normal}, 5).reason,
               contains("show 'beauty'"));
}

TEST_CASE("Answers: the passes of a picture with its field, or the reason why it has no paths") {
    SessionBench bench;
    bench.render(kLearning, 3);
    const PathsAnswer answer = answer_paths(bench.session, kLearning, 5);
    REQUIRE(answer.value);
    CHECK(answer.value->plain.samples == 3);
    CHECK(answer.value->shows_guided);
    CHECK(answer.generation == 5);
    CHECK_THAT(answer_paths(bench.session, {MethodId::Default, View::Normal}, 5).reason, contains("show 'beauty'"));
}
