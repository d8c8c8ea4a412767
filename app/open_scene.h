// Loading a scene for a subcommand, with its time.
#pragma once

#include <memory>
#include <string>

#include "app/console.h"
#include "core/io/load_settings.h"
#include "core/scene/description.h"

namespace pl {

struct LoadedScene {
    std::shared_ptr<const SceneDescription> scene;
    double load_seconds = 0.0;
};

/// A scene by name or path, opened by load_scene(); its warnings go to the log. Throws Error(Input), and Error(Usage) for
/// unknown knobs or values.
LoadedScene open_scene(const std::string& name_or_path, const LoadSettings& asked, Console& console);

}  // namespace pl
