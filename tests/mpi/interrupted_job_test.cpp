// Renderings that are interrupted again and again and go on with other numbers of ranks: the bits of one uninterrupted process.
#include <array>

#include "core/io/checkpoint_file.h"
#include "tests/core/session/interruption.h"
#include "tests/mpi/thread_ranks.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::size_t kInterruptions = 10;
/// In turns, so that each piece of work has another number than the one before.
constexpr std::array kRanks{1, 3, 2, 5};

/// All that a session has but times.
struct Outcome {
    State state;
    Refinement refinement;
    std::vector<FieldProgress> fields;
};

Outcome outcome_of(Session& session) {
    Outcome outcome{.state = state_of(session), .refinement = session.refinement(), .fields = {}};
    for (const SavedField& field : session.save_state().fields) {
        outcome.fields.push_back(field.progress);
        outcome.fields.back().precompute_seconds = 0.0;
    }
    return outcome;
}

bool same_outcome(const Outcome& a, const Outcome& b) {
    return same_state(a.state, b.state) && a.refinement == b.refinement && a.fields == b.fields;
}

/// How often a rendering was taken out of its session within a piece of work.
struct Interruptions {
    int in_first_pass = 0;
    int in_later_passes = 0;
    int in_slices = 0;  ///< of the precomputation

    void count(const Session& session) {
        const bool is_first = session.passes(slot_of(session)) == 0;
        if (slice_is_partial(session)) ++in_slices;
        if (pass_is_partial(session)) ++(is_first ? in_first_pass : in_later_passes);
    }
};

/// Numbers of complete passes, and of slices before them, from which on there is an interruption. The first two are at the beginning.
std::vector<std::uint32_t> random_moments(std::uint32_t end, Uniforms& random) {
    std::vector<std::uint32_t> moments(kInterruptions, 0);
    for (std::size_t i = 2; i < moments.size(); ++i) moments[i] = random.below(end);
    std::ranges::sort(moments);
    return moments;
}

/// Pixels of a share: several blocks even for five ranks, and stops between them.
constexpr std::uint32_t kSharePixels = 128;

/// A session on one process, or over ranks; interrupted at a moment that is chosen by time, or by the number of messages.
class Piece {
public:
    Piece(int size, std::shared_ptr<const SceneDescription> scene, const RenderSettings& settings)
        : ranks_(size),
          session_(size == 1 ? make_cpu_backend({.threads = 2, .batch_paths = 32}) : ranks_.backend(1, kSharePixels),
                   std::move(scene), settings) {}

    Session& session() { return session_; }

    Progress interrupt(Uniforms& random) {
        const auto size = static_cast<std::uint32_t>(ranks_.first().size());
        if (size == 1) return advance_interrupted(session_, random.next());
        const RenderSettings& settings = session_.settings();
        const auto blocks = static_cast<std::uint32_t>(settings.width * settings.height) / (kSharePixels * size);
        StopFlag stop{false};
        std::uint32_t messages = random.below(blocks + 2);
        ranks_.first().set_on_message([&] { stop = stop || messages-- == 0; });
        const Progress progress = session_.advance(slot_of(session_), &stop);
        ranks_.first().set_on_message({});
        return progress;
    }

private:
    ThreadRanks ranks_;
    Session session_;
};

Outcome render_interrupted(const SceneDescription& scene, const RenderSettings& settings, std::uint32_t passes,
                           Uniforms& random, Interruptions& counted) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "c";
    const auto shared_scene = std::make_shared<const SceneDescription>(scene);
    const bool precomputes = settings.method == MethodId::Precomputed;
    const std::uint32_t end =
        passes + (precomputes ? static_cast<std::uint32_t>(settings.field.precompute_samples) : 0);
    std::uint32_t done = 0;
    std::size_t turn = 0;
    for (const std::uint32_t moment : random_moments(end, random)) {
        Piece piece(kRanks[turn % kRanks.size()], shared_scene, settings);
        Session& session = piece.session();
        if (turn++ > 0) session.restore_state(read_checkpoint(file).state);
        for (; done < moment; ++done) session.advance(slot_of(session));
        if (done < end && piece.interrupt(random) != Progress::Stopped) ++done;
        counted.count(session);
        write_checkpoint(file, {.seconds = 0.0, .state = session.save_state()});
    }
    Piece last(kRanks[turn % kRanks.size()], shared_scene, settings);
    last.session().restore_state(read_checkpoint(file).state);
    for (; done < end; ++done) last.session().advance(slot_of(settings));
    return outcome_of(last.session());
}

}  // namespace

// The Cornell box shows its lamp, whose border is looked for in the passes 2 to 5. Refinement begins after 8 passes.
TEST_CASE("A rendering that is interrupted at ten moments, each time with other ranks, has the bits of one process") {
    constexpr std::uint32_t kPasses = 11;
    const SceneDescription scene = shipped_scene("cornell");
    Uniforms random(1);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator);
        settings.field.refine_share = 0.5f;
        Session one = make_session(scene, settings, 2);
        while (one.passes(slot_of(one)) < kPasses) one.advance(slot_of(one));
        const Outcome expected = outcome_of(one);
        CHECK((expected.refinement.added > 0) == (estimator.method == MethodId::Reinforcement));
        const bool has_slices = estimator.method == MethodId::Precomputed;
        Interruptions counted;
        while (counted.in_first_pass == 0 || counted.in_later_passes == 0 || (has_slices && counted.in_slices == 0))
            CHECK(same_outcome(expected, render_interrupted(scene, settings, kPasses, random, counted)));
    }
}
