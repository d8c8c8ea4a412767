// Blends of materials: the chains of their components, and errors in them.
#pragma once

#include <span>
#include <string>

#include "core/scene/description.h"

namespace pl {

/// The error in the blend of one of the materials, empty if there is none: no such material, a circle, more than kMostBlends in a row,
/// or solid glass, which paths would enter as one material and leave as another.
std::string error_of_blend(std::span<const MaterialDescription> materials, const MaterialDescription& material);

/// Whether a predicate is true of a material or of one that it blends with. The blends are valid.
template <class Predicate>
bool any_shown(std::span<const MaterialDescription> materials, std::uint32_t material, Predicate&& predicate) {
    for (; material != kNoMaterial; material = materials[material].blend.other)
        if (predicate(materials[material])) return true;
    return false;
}

}  // namespace pl
