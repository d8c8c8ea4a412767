#include "core/scene/punctual_lights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/kernel/base/math.h"

namespace pl {
namespace {

std::string triple(const glm::vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

/// The fault of a light; empty without one.
std::string complaint_about(const PunctualLightDescription& light) {
    const glm::vec3& power = light.intensity;
    if (!is_finite(power) || power.x < 0.0f || power.y < 0.0f || power.z < 0.0f)
        return fmt::format("intensity {} is not finite and at least 0", triple(power));
    if (!is_finite(light.position)) return fmt::format("position {} is not finite", triple(light.position));
    if (light.kind == PunctualKind::Point) return "";
    const double length = glm::length(glm::dvec3(light.direction));
    if (!std::isfinite(length) || !(length > 0.0)) return fmt::format("{} is no direction", triple(light.direction));
    if (light.kind == PunctualKind::Spot && !are_cones(light.inner_deg, light.outer_deg))
        return fmt::format("expected 0 <= inner <= outer, and 0 < outer <= {} degrees, got {} and {}", kMostSpotAngle,
                           light.inner_deg, light.outer_deg);
    return "";
}

}  // namespace

bool are_cones(float inner_deg, float outer_deg) {
    return inner_deg >= 0.0f && inner_deg <= outer_deg && outer_deg > 0.0f && outer_deg <= kMostSpotAngle;
}

std::string count_text(const std::vector<PunctualLightDescription>& lights) {
    std::vector<std::string> parts;
    for (const ChoiceInfo<PunctualKind>& info : kChoices<PunctualKind>) {
        const auto count = std::ranges::count(lights, info.value, &PunctualLightDescription::kind);
        if (count > 0) parts.push_back(fmt::format("{} {} light{}", count, info.name, count == 1 ? "" : "s"));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string complaints_about(const std::vector<PunctualLightDescription>& lights) {
    std::string list;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string complaint = complaint_about(lights[i]);
        if (!complaint.empty()) list += fmt::format("\n  light {}: {}", i + 1, complaint);
    }
    return list;
}

}  // namespace pl
