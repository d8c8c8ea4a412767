#include "app/open_scene.h"

#include "core/base/timer.h"
#include "core/io/load_scene.h"

namespace pl {

LoadedScene open_scene(const std::string& name_or_path, const LoadSettings& asked, Console& console) {
    const Stopwatch watch;
    LoadedScene loaded;
    loaded.scene = std::make_shared<const SceneDescription>(load_scene(name_or_path, find_assets_dir(), asked));
    loaded.load_seconds = watch.seconds();
    console.warn_about(*loaded.scene);
    return loaded;
}

}  // namespace pl
