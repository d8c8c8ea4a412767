// A viewer model with a folder for its files.
#pragma once

#include "core/base/error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/model_bench.h"

namespace pl::test {
using namespace pl::ui;

struct FileBench : ModelBench {
    std::shared_ptr<FakeControl> control = devices.cpu;
    TemporaryFolder folder;

    FileBench() : ModelBench(64) {
        options.settings.next_event = false;
        options.settings.field.volumes = 16;
        options.settings.field.bins = 16;
        options.screenshot_dir = folder.path();
        control->pass_microseconds = 0;
        options.backends = {{"cpu", "", ""}, {"cuda", "", ""}};
        options.load_scene = [](const SceneRequest& request) -> std::shared_ptr<const SceneDescription> {
            if (request.name == "broken.obj")
                throw Error(ErrorKind::Input, "broken.obj:7: expected a number, got 'x'");
            auto scene = std::make_shared<SceneDescription>(*small_scene());
            scene->camera.eye.y = 1.5f;
            return scene;
        };
        options.command_line = [](const ViewerPicture& picture) { return "pathlight render " + picture.scene.name; };
    }
};

inline bool has_frame(const ViewerModel& model) { return model.frame() != nullptr; }

}  // namespace pl::test
