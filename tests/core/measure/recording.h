// A session of a furnace and the runs that follow it.
#pragma once

#include <limits>

#include "core/measure/live_runs.h"
#include "core/measure/picture_identity.h"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/session/sessions.h"

namespace pl::test {

inline constexpr int kSide = 16;
inline constexpr std::size_t kPictureBytes = kSide * kSide * 6;
inline constexpr std::size_t kPlenty = 1u << 24;
inline constexpr double kAlways = std::numeric_limits<double>::infinity();  ///< share
inline constexpr float kEmission = 0.5f;
inline constexpr float kAlbedo = 0.5f;

/// A session and the runs that follow it.
struct Recording {
    SceneDescription scene = furnace_scene(kEmission, kAlbedo);
    Session session;
    LiveRuns runs;
    FilmSlot slot;

    explicit Recording(std::size_t cap = kPlenty, double share = kAlways, MethodId method = MethodId::Default,
                       LiveRuns::Clock clock = {})
        : session(make_session(scene, quick_learner(scene, {method, false}, kSide, 1))),
          runs(cap, {}, share, std::move(clock)), slot{method, View::Beauty} {}

    /// Renders so many more samples per pixel, observed one by one; the number of changes of the set.
    int render(std::uint32_t passes) {
        int changes = 0;
        const std::uint32_t target = session.passes(slot) + passes;
        while (session.passes(slot) < target) {
            session.advance(slot);
            changes += runs.observe(session, slot) ? 1 : 0;
        }
        return changes;
    }
    /// Renders until the picture has so many more points, however busy the machine.
    void record(std::size_t points) {
        for (std::size_t added = 0; added < points;) {
            const std::size_t before = points_in_progress();
            render(1);
            added += points_in_progress() > before ? 1 : 0;
        }
    }
    std::size_t points_in_progress() const {
        for (const auto& run : runs.current()->runs)
            if (run->in_progress) return run->points.size();
        return 0;
    }
    std::size_t count() const { return runs.current()->runs.size(); }
    const LiveRun& run(std::size_t i) const { return *runs.current()->runs.at(i); }
    const LiveRun& last() const { return *runs.current()->runs.back(); }

    std::shared_ptr<LiveReference> truth() const {
        const std::vector<Vec3f> exact(kSide * kSide, Vec3f(kEmission / (1.0f - kAlbedo)));
        return std::make_shared<LiveReference>(
            LiveReference{.picture = picture_key(session.scene_hash(), session.settings()),
                          .width = kSide,
                          .height = kSide,
                          .first = exact,
                          .second = exact});
    }
};

}  // namespace pl::test
