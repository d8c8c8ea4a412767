// Lights without extent in words.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/choice.h"
#include "core/scene/description.h"

namespace pl {

template <>
inline constexpr auto kChoices<PunctualKind> = std::to_array<ChoiceInfo<PunctualKind>>({
    {PunctualKind::Point, "point", "Point"},
    {PunctualKind::Spot, "spot", "Spot"},
    {PunctualKind::Directional, "directional", "Directional"},
});

template <>
inline constexpr auto kChoices<SpotFalloff> = std::to_array<ChoiceInfo<SpotFalloff>>({
    {SpotFalloff::Cosine, "cosine", "Cosine"},
    {SpotFalloff::Angle, "angle", "Angle"},
});

/// "2 point lights, 1 directional light"; empty without lights.
std::string count_text(const std::vector<PunctualLightDescription>& lights);

/// Whether a spot can have these half angles: 0 <= inner <= outer, and 0 < outer <= kMostSpotAngle. Equal ones make a hard edge.
bool are_cones(float inner_deg, float outer_deg);

/// Lines about lights that are not valid; empty if all are.
std::string complaints_about(const std::vector<PunctualLightDescription>& lights);

}  // namespace pl
