// Fingerprint of a scene: equal for files that describe the same light, different for those that do not.
#pragma once

#include <string>

#include "core/scene/description.h"

namespace pl {

/// 16 hexadecimal digits over everything that decides the light: geometry, normals, materials, textures, environment. Names,
/// paths, the camera and settings do not count: they are told apart by what is recorded beside the hash.
std::string scene_hash(const SceneDescription& scene);

}  // namespace pl
