// Lights without extent in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// "point", "spot" or "directional": in files and for people.
std::string_view name_of(PunctualKind kind);
/// "cosine" or "angle".
std::string_view name_of(SpotFalloff falloff);

/// "2 point lights, 1 directional light"; empty without lights.
std::string count_text(const std::vector<PunctualLightDescription>& lights);

/// Whether a spot can have these half angles: 0 <= inner <= outer, and 0 < outer <= kMostSpotAngle. Equal ones make a hard edge.
bool are_cones(float inner_deg, float outer_deg);

/// Lines about lights that are not valid; empty if all are.
std::string complaints_about(const std::vector<PunctualLightDescription>& lights);

}  // namespace pl
