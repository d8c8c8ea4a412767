// Sessions on the CPU back end for tests, and pictures from them as independent batches.
#pragma once

#include <array>
#include <memory>
#include <ostream>

#include "core/session/session.h"
#include "cpu/cpu_backend.h"
#include "tests/support/statistics/rules.h"

namespace pl::test {

/// An estimator of a scene's light: a method, with or without light samples.
struct Estimator {
    MethodId method = MethodId::Default;
    bool next_event = false;

    std::string name() const {
        return std::string(info_of(method).name) + (next_event ? " with next-event estimation" : "");
    }
};
inline std::ostream& operator<<(std::ostream& out, const Estimator& estimator) { return out << estimator.name(); }

inline constexpr std::array kEstimators{
    Estimator{MethodId::Default, false},       Estimator{MethodId::Default, true},
    Estimator{MethodId::Precomputed, false},   Estimator{MethodId::Precomputed, true},
    Estimator{MethodId::Reinforcement, false}, Estimator{MethodId::Reinforcement, true}};

/// What tests of learning render.
inline constexpr MethodId kLearner = MethodId::Reinforcement;
inline constexpr Estimator kLearningPaths{kLearner, false};
inline constexpr FilmSlot kLearningFilm{kLearner, View::Beauty};

inline RenderSettings settings_for(const SceneDescription& scene, Estimator estimator, int width, int height) {
    RenderSettings settings;
    settings.method = estimator.method;
    settings.next_event = estimator.next_event;
    settings.width = width;
    settings.height = height;
    settings.camera = scene.camera;
    settings.guiding = GuidingRule::Always;  // tests of guided paths are about these
    settings.field.precompute_samples = 4;   // by a map as of a long run
    return settings;
}

/// A square picture with small tables that are learned from few samples, so that guiding sets in within the time of a
/// test.
inline RenderSettings quick_learner(const SceneDescription& scene, Estimator estimator, int side,
                                    std::uint64_t seed) {
    RenderSettings settings = settings_for(scene, estimator, side, side);
    settings.seed = seed;
    settings.field.volumes = 200;
    settings.field.bins = 64;
    return settings;
}

/// One thread by default: ctest keeps the cores busy with several tests.
inline Session make_session(const SceneDescription& scene, const RenderSettings& settings, int threads = 1) {
    return Session(make_cpu_backend({.threads = threads}), std::make_shared<const SceneDescription>(scene), settings);
}

/// The film that the settings of a test ask for, in tests that render no other.
inline FilmSlot slot_of(const Session& session) { return slot_of(session.settings()); }

/// Advances until `passes` more samples per pixel are in the film, after the precomputation.
inline void render_passes(Session& session, FilmSlot slot, std::uint32_t passes) {
    const std::uint32_t target = session.passes(slot) + passes;
    while (session.passes(slot) < target) session.advance(slot);
}
inline void render_passes(Session& session, std::uint32_t passes) {
    render_passes(session, slot_of(session), passes);
}

/// A picture per channel. The channels of a picture are not independent, so each is judged alone.
struct Picture {
    std::array<TiledBatches, 3> channels;

    Picture(int width, int height, int tile = 16)
        : channels{TiledBatches(width, height, tile), TiledBatches(width, height, tile),
                   TiledBatches(width, height, tile)} {}

    /// `sums` are over `samples` samples of every pixel.
    void add(const std::vector<Vec3d>& sums, double samples) {
        std::vector<double> values(sums.size());
        for (std::size_t c = 0; c < channels.size(); ++c) {
            for (std::size_t i = 0; i < sums.size(); ++i) values[i] = sums[i][static_cast<int>(c)] / samples;
            channels[c].add(values);
        }
    }
};

/// A film's means times its number of samples. Means are read as floats, so differences of sums keep 24 bits of
/// the larger one, which is far below any sampling error here.
inline std::vector<Vec3d> film_sums(const Session& session) {
    const Snapshot snapshot = session.snapshot(slot_of(session));
    std::vector<Vec3d> sums;
    sums.reserve(snapshot.pixels.size());
    for (const Vec3f& mean : snapshot.pixels) sums.push_back(Vec3d{mean} * static_cast<double>(snapshot.passes));
    return sums;
}

/// Renders on and adds `batches` batches of `passes` samples per pixel each.
inline void render_batches(Session& session, Picture& picture, int batches, std::uint32_t passes) {
    std::vector<Vec3d> before = film_sums(session);
    for (int batch = 0; batch < batches; ++batch) {
        render_passes(session, passes);
        std::vector<Vec3d> after = film_sums(session);
        for (std::size_t i = 0; i < after.size(); ++i) before[i] = after[i] - before[i];
        picture.add(before, passes);
        before = std::move(after);
    }
}

/// Rule S2 in every channel; the worst decision.
inline Decision same_picture(const Picture& a, const Picture& b, double delta) {
    Decision worst = same_mean(a.channels[0], b.channels[0], delta);
    for (std::size_t c = 1; c < a.channels.size(); ++c)
        worst = worse_of(worst, same_mean(a.channels[c], b.channels[c], delta));
    return worst;
}

}  // namespace pl::test
