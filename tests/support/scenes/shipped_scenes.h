// The scenes that come with the program.
#pragma once

#include "core/io/load_scene.h"

namespace pl::test {

inline SceneDescription shipped_scene(const std::string& name) { return load_scene(name, find_assets_dir()); }

}  // namespace pl::test
