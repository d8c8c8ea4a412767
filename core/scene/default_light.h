// The light of scenes that have none: a sky with a soft sun, as an environment map.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/description.h"

namespace pl {

enum class SceneLight {
    Own,      ///< the scene's
    Default,  ///< of add_default_light()
    None      ///< every picture is black
};

/// The light of a scene. Its own is emitted by a triangle, with regard to the texels of its emission map, by the
/// environment, its map, the sun, or a light without extent; a material that no triangle has emits nothing.
SceneLight light_of(const SceneDescription& scene);

/// Its name in files: "scene", "default", "none".
std::string_view name_of(SceneLight light);

/// In words, for people: "default: a sky with a soft sun, +z is up".
std::string light_text(const SceneDescription& scene);

/// Lights a scene whose light_of() is None: sets its environment map and `default_light`. The sky is brighter at the
/// horizon, the ground below it is dull; scene.up is up. The sun is a lobe 34 degrees wide at half of its radiance,
/// so that paths find it without light samples. It stands 50 degrees high, 45 degrees to the left of scene.camera as seen
/// from the target: over the left shoulder of whoever looks. A white Lambert reflector that faces it has a radiance of
/// about 1: white at exposure 0. Expects a valid scene.
void add_default_light(SceneDescription& scene);

}  // namespace pl
