// A session over a fake back end, for tests of the render thread's parts.
#pragma once

#include "core/session/session.h"
#include "tests/ui/fake_backend.h"

namespace pl::test {
using namespace pl::ui;

struct SessionBench {
    std::shared_ptr<FakeControl> control = std::make_shared<FakeControl>();
    Session session;

    explicit SessionBench(int size = 16, int probes = 1)
        : session(std::make_shared<FakeBackend>(control), small_scene(), settings_of(size, probes)) {}

    void render(FilmSlot slot, std::uint32_t passes) {
        const std::uint32_t target = session.passes(slot) + passes;
        while (session.passes(slot) < target) session.advance(slot);
    }

private:
    static RenderSettings settings_of(int size, int probes) {
        RenderSettings settings{.next_event = false};
        settings.width = size;
        settings.height = size;
        settings.camera = small_scene()->camera;
        settings.field.volumes = 16;
        settings.field.bins = 16;
        settings.field.precompute_samples = probes;
        return settings;
    }
};

inline constexpr FilmSlot kDefault{MethodId::Default, View::Beauty};
inline constexpr FilmSlot kLearning{MethodId::Reinforcement, View::Beauty};

}  // namespace pl::test
