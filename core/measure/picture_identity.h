// The identity of a converged picture: references are found by it, and pictures of other light refused.
#pragma once

#include <cstdint>
#include <string>

#include "core/session/settings.h"

namespace pl {

/// Key of the hash in metadata of pictures and in manifests.
inline constexpr const char* kPictureHashKey = "picture_hash";

/// Over the scene's light (scene_hash()), the camera, the size and the maximal depth; not over method, next-event
/// estimation, seed, field or back end, which change the noise and never the mean.
std::uint64_t picture_key(const std::string& scene_hash, const RenderSettings& settings);
/// A picture_key() as 16 hexadecimal digits.
std::string picture_hash(std::uint64_t key);
inline std::string picture_hash(const std::string& scene_hash, const RenderSettings& settings) {
    return picture_hash(picture_key(scene_hash, settings));
}

}  // namespace pl
