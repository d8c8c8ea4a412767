// Scenes of Mitsuba from text, for tests of their reader.
#pragma once

#include <string>

#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/files/told.h"

namespace pl::test {

inline std::string scene_of(const std::string& content) {
    return "<scene version=\"3.0.0\">\n" + content + "\n</scene>\n";
}

/// Read from s.xml in the folder.
inline SceneDescription load_mitsuba_text(const TemporaryFolder& folder, const std::string& content) {
    return load_scene(folder.write("s.xml", scene_of(content)).string(), "");
}
inline SceneDescription load_mitsuba_text(const std::string& content) {
    return load_mitsuba_text(TemporaryFolder(), content);
}

/// A rectangle with this surface.
inline SceneDescription scene_with(const std::string& bsdf) {
    return load_mitsuba_text("<shape type=\"rectangle\">" + bsdf + "</shape>");
}
/// The only material of that scene.
inline MaterialDescription surface(const std::string& bsdf) {
    const SceneDescription scene = scene_with(bsdf);
    REQUIRE(scene.materials.size() == 1);
    return scene.materials[0];
}

/// The message by which it is refused.
inline std::string refusal(const std::string& content) {
    return input_error([&] { load_mitsuba_text(content); });
}

inline const std::string kSquare = "<shape type=\"rectangle\"/>";

}  // namespace pl::test
