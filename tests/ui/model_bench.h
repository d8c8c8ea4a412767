// A viewer model over fake back ends, with the frames of its window one after the other.
#pragma once

#include <algorithm>

#include "tests/ui/fake_backend.h"
#include "ui/model/viewer_model.h"

namespace pl::test {
using namespace pl::ui;

struct ModelBench {
    FakeDevices devices;
    ViewerOptions options;
    double clock = 0.0;

    explicit ModelBench(int size) {
        options.scene_name = "small";
        options.settings.width = size;
        options.settings.height = size;
        options.settings.camera = small_scene()->camera;
        options.settings.next_event = false;
        options.make_backend = devices.maker();
        options.make_side_backend = options.make_backend;
        devices.cpu->pass_microseconds = 200;
    }
    template <class Condition>
    bool run_until(ViewerModel& model, Condition&& condition) {
        return eventually([&] {
            model.update(clock += 1.0 / 60.0);
            return condition();
        });
    }
};

/// Whether a message with this part was logged.
inline bool told(const ViewerModel& model, const std::string& part) {
    return std::ranges::any_of(model.messages().log(),
                               [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

}  // namespace pl::test
