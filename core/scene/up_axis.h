// The vertical axis of models: as asked for, or guessed from the geometry.
#pragma once

#include <array>

#include "core/base/choice.h"
#include "core/scene/description.h"

namespace pl {

enum class UpAxis { Auto, X, Y, Z };

template <>
inline constexpr auto kChoices<UpAxis> = std::to_array<ChoiceInfo<UpAxis>>({
    {UpAxis::Auto, "auto", "Automatic", "y or z, guessed from the geometry"},
    {UpAxis::X, "x", "x"},
    {UpAxis::Y, "y", "y"},
    {UpAxis::Z, "z", "z"},
});

/// +y or +z, of which OBJ files say nothing. The first rule that applies:
/// 1. The model stands on the plane y = 0 or z = 0: its bounds begin there, within a twentieth of their extent, and
///    contain 0 in their middle half along the other two axes. That axis is up.
/// 2. The area projected along z is at least twice the area along x and the area along y, as of a table or a terrain:
/// z is up.
///    Instances count as boxes.
/// 3. y is up, which is the convention of OBJ files.
/// The scene must have a triangle.
glm::vec3 guess_up(const SceneDescription& scene);

/// The direction of an axis; for UpAxis::Auto guess_up().
glm::vec3 up_direction(UpAxis axis, const SceneDescription& scene);

/// The axis, with its sign, that is nearest to a direction; of equal ones the first.
glm::vec3 nearest_axis(const glm::vec3& direction);

/// The direction from a model to whoever stands in front of it, by the custom of its vertical axis: +z if y or x is up,
/// -y if z is up. `up` is an axis; with a minus the model is turned over about its left-to-right axis.
glm::vec3 front_of(const glm::vec3& up);

}  // namespace pl
