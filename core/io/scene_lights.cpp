#include "core/io/scene_lights.h"

#include <string>

#include <fmt/format.h>

#include "core/scene/punctual_lights.h"

namespace pl {
namespace {

PunctualKind read_kind(const JsonDocument& file, const std::string& at) {
    const std::string name = file.text(at + "/type").value_or("");
    for (const PunctualKind kind : {PunctualKind::Point, PunctualKind::Spot, PunctualKind::Directional})
        if (name == name_of(kind)) return kind;
    file.fail(at + "/type", fmt::format("expected point, spot or directional, got '{}'", name));
}

SpotFalloff read_falloff(const JsonDocument& file, const std::string& at) {
    const std::string name = file.text(at + "/falloff").value_or("cosine");
    for (const SpotFalloff falloff : {SpotFalloff::Cosine, SpotFalloff::Angle})
        if (name == name_of(falloff)) return falloff;
    file.fail(at + "/falloff", fmt::format("expected cosine or angle, got '{}'", name));
}

glm::vec3 required(const JsonDocument& file, const std::string& pointer, const std::optional<glm::vec3>& value) {
    if (!value) file.fail(pointer, "expected three numbers, got none");
    return *value;
}

glm::vec3 required_vector(const JsonDocument& file, const std::string& pointer) {
    return required(file, pointer, file.vector(pointer));
}

void read_direction(const JsonDocument& file, const std::string& pointer, PunctualLightDescription& light) {
    light.direction = required_vector(file, pointer);
    if (light.direction == glm::vec3(0.0f)) file.fail(pointer, "expected a direction, got a vector of no length");
}

void read_cones(const JsonDocument& file, const std::string& at, PunctualLightDescription& light) {
    light.inner_deg = file.number(at + "/inner_deg").value_or(light.inner_deg);
    light.outer_deg = file.number(at + "/outer_deg").value_or(light.outer_deg);
    light.falloff = read_falloff(file, at);
    if (!are_cones(light.inner_deg, light.outer_deg))
        file.fail(at, fmt::format("expected 0 <= inner_deg <= outer_deg, and 0 < outer_deg <= {}, got {} and {}",
                                  kMostSpotAngle, light.inner_deg, light.outer_deg));
}

PunctualLightDescription read_punctual_light(const JsonDocument& file, const std::string& at) {
    PunctualLightDescription light{.kind = read_kind(file, at)};
    switch (light.kind) {
    case PunctualKind::Point: file.object(at, {"type", "position", "intensity"}); break;
    case PunctualKind::Spot:
        file.object(at, {"type", "position", "direction", "intensity", "inner_deg", "outer_deg", "falloff"});
        break;
    case PunctualKind::Directional: file.object(at, {"type", "direction", "irradiance"}); break;
    }
    const bool is_far = light.kind == PunctualKind::Directional;
    const std::string strength = at + (is_far ? "/irradiance" : "/intensity");
    light.intensity = required_vector(file, strength);
    if (glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f))))
        file.fail(strength, "expected numbers of at least 0");
    if (!is_far) light.position = required(file, at + "/position", file.point(at + "/position"));
    if (light.kind != PunctualKind::Point) read_direction(file, at + "/direction", light);
    if (light.kind == PunctualKind::Spot) read_cones(file, at, light);
    return light;
}

}  // namespace

void read_punctual_lights(const JsonDocument& file, SceneDescription& scene) {
    const auto all = file.root().find("lights");
    if (all != file.root().end() && !all->is_array()) file.fail("/lights", "expected an array [ ... ]");
    for (std::size_t i = 0; i < file.array_size("/lights"); ++i)
        scene.punctual_lights.push_back(read_punctual_light(file, fmt::format("/lights/{}", i)));
}

Json punctual_light_json(const PunctualLightDescription& light) {
    Json json{{"type", name_of(light.kind)}};
    const bool is_far = light.kind == PunctualKind::Directional;
    json[is_far ? "irradiance" : "intensity"] = vector_json(light.intensity);
    if (!is_far) json["position"] = vector_json(light.position);
    if (light.kind != PunctualKind::Point) json["direction"] = vector_json(light.direction);
    if (light.kind != PunctualKind::Spot) return json;
    json["inner_deg"] = light.inner_deg;
    json["outer_deg"] = light.outer_deg;
    json["falloff"] = name_of(light.falloff);
    return json;
}

}  // namespace pl
