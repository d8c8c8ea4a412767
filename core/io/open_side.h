// Boxes that are open on one side, as rooms are that were modelled to be looked into.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

/// The side of the scene's bounds through which one looks deep into them: of kOpenSideGrid^2 parallel rays nine tenths meet
/// a surface, on average more than half the extent behind the side. A horizontal axis with its sign, pointing
/// out of the scene; the deepest one, and of equal ones the first of front_of(scene.up), its opposite, right and left.
/// Instances count as boxes around them. Empty if there is none, as for everything that is flat in the direction of the rays.
std::optional<glm::vec3> open_side(const SceneDescription& scene);

inline constexpr int kOpenSideGrid = 32;

}  // namespace pl
