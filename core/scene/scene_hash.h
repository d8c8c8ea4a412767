// Hash of a scene: equal for files that describe the same light transport.
#pragma once

#include <string>

#include "core/scene/description.h"

namespace pl {

/// 16 hexadecimal digits over geometry, normals, materials, textures and environment. Names, paths, camera and
/// settings do not count; files store them beside the hash. A default light counts, which stands by the file's camera.
std::string scene_hash(const SceneDescription& scene);

}  // namespace pl
