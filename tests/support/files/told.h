// Warnings of the readers of scenes.
#pragma once

#include <algorithm>
#include <string>

#include "core/scene/description.h"

namespace pl::test {

/// Whether a warning has these words.
inline bool is_told(const SceneDescription& scene, const std::string& words) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

}  // namespace pl::test
