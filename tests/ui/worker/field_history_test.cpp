#include "ui/worker/field_history.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

constexpr std::size_t kPlenty = std::size_t{1} << 30;

std::vector<std::uint64_t> passes_of(const FieldHistory& history) {
    std::vector<std::uint64_t> passes;
    for (const auto& frame : history.frames) passes.push_back(frame->passes());
    return passes;
}

void learn(SessionBench& bench, FieldHistoryRecorder& recorder, std::uint32_t passes) {
    for (std::uint32_t i = 0; i < passes; ++i) {
        bench.render(kLearning, 1);
        (void)recorder.observe(bench.session, MethodId::Reinforcement);
    }
}

}  // namespace

TEST_CASE("Field history: nothing is kept without a limit") {
    SessionBench bench;
    FieldHistoryRecorder recorder;
    learn(bench, recorder, 3);
    CHECK(recorder.history()->frames.empty());
    CHECK(recorder.history()->bytes == 0);
}

TEST_CASE("Field history: every one of the first passes, then fewer and fewer") {
    SessionBench bench;
    FieldHistoryRecorder recorder;
    recorder.set_limit(kPlenty);
    CHECK_FALSE(recorder.observe(bench.session, MethodId::Reinforcement));  // nothing is learned
    learn(bench, recorder, 32);
    CHECK(passes_of(*recorder.history()) ==
          std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 20, 25, 32});
    CHECK_FALSE(recorder.observe(bench.session, MethodId::Reinforcement));
    CHECK(recorder.history()->evicted == 0);
    const std::vector<std::uint64_t> passes = passes_of(*recorder.history());
    for (std::size_t i = 1; i < passes.size(); ++i) CHECK(next_key_frame(passes[i - 1]) == passes[i]);
}

TEST_CASE("Field history: a frame has the field of its pass") {
    SessionBench bench;
    FieldHistoryRecorder recorder;
    recorder.set_limit(kPlenty);
    learn(bench, recorder, 2);
    const VolumeInspection then = bench.session.inspect_volume(MethodId::Reinforcement, 0);
    learn(bench, recorder, 10);
    const VolumeInspection now = bench.session.inspect_volume(MethodId::Reinforcement, 0);
    CHECK(then.radiance != now.radiance);
    const FieldHistory& history = *recorder.history();
    CHECK(history.frames[1]->inspect(0).radiance == then.radiance);
    CHECK(history.frames[1]->inspect(0).density == then.density);
    CHECK(history.frames.back()->inspect(0).radiance == now.radiance);
    CHECK(history.frames.back()->inspect(0).bsdf_fraction == now.bsdf_fraction);
    CHECK(history.frames.back()->probabilities(0) == now.probability);
    CHECK(now.probability.size() == static_cast<std::size_t>(now.side * now.side));
    CHECK(history.bytes == history.frames.size() * history.frames[0]->bytes());
}

TEST_CASE("Field history: beyond its memory it stays spread over the logarithm of the passes") {
    SessionBench bench;
    FieldHistoryRecorder recorder;
    recorder.set_limit(kPlenty);
    learn(bench, recorder, 1);
    const std::size_t one = recorder.history()->bytes;
    recorder.set_limit(6 * one);
    learn(bench, recorder, 63);
    const FieldHistory& history = *recorder.history();
    CHECK(history.bytes <= 6 * one);
    CHECK(history.frames.size() == 6);
    CHECK(history.evicted > 10);
    const std::vector<std::uint64_t> passes = passes_of(history);
    CHECK(passes.front() == 1);
    for (std::size_t i = 1; i < passes.size(); ++i) CHECK(passes[i] <= 4 * passes[i - 1]);

    // Less memory takes effect at once, down to the first and the last frame.
    recorder.set_limit(3 * one);
    CHECK(recorder.history()->frames.size() == 3);
    recorder.set_limit(1);
    CHECK(passes_of(*recorder.history()) == std::vector<std::uint64_t>{passes.front(), passes.back()});

    CHECK(frame_to_evict({1, 2, 3, 4}) == 2);      // 4 / 2 is nearer than 3 / 1
    CHECK(frame_to_evict({1, 4, 8, 9, 64}) == 2);  // 9 / 4
    CHECK(frame_to_evict({0, 1, 2}) == 1);         // a field that was precomputed
}

TEST_CASE("Field history: a forgotten field begins a new history, and giving up the past frees it") {
    SessionBench bench;
    FieldHistoryRecorder recorder;
    recorder.set_limit(kPlenty);
    learn(bench, recorder, 5);
    const auto old = recorder.history();
    bench.session.apply(EditForget{});
    learn(bench, recorder, 2);
    CHECK(passes_of(*recorder.history()) == std::vector<std::uint64_t>{1, 2});
    CHECK(old->frames.size() == 5);  // as the window still has it
    recorder.set_limit(0);
    CHECK(recorder.history()->frames.empty());
}
