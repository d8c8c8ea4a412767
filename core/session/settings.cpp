#include "core/session/settings.h"

#include <fmt/format.h>

#include "core/session/choices.h"

namespace pl {
namespace {

std::string text_of(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

template <class T>
std::string text_of(T value) {
    if constexpr (Described<T>)
        return std::string(name_of(value));
    else
        return fmt::format("{}", value);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> settings_text(const RenderSettings& settings) {
    std::vector<std::pair<std::string, std::string>> text;
    const auto add = [&](const char* name, const auto& value) { text.emplace_back(name, text_of(value)); };
    text.emplace_back("method", info_of(settings.method).name);
    text.emplace_back("view", info_of(settings.view).name);
    text.emplace_back("size", fmt::format("{}x{}", settings.width, settings.height));
    add("seed", settings.seed);
    add("eye", settings.camera.eye);
    add("target", settings.camera.target);
    add("up", settings.camera.up);
    add("fov", settings.camera.fov_deg);
    add("aperture", settings.camera.aperture_radius);
    add("focus", settings.camera.focus_distance);
    if (settings.camera.shift.x != 0.0f) add("shift-x", settings.camera.shift.x);
    if (settings.camera.shift.y != 0.0f) add("shift-y", settings.camera.shift.y);
    if (settings.camera.is_mirrored) text.emplace_back("mirrored", "true");
    add("max-depth", settings.max_depth);
    text.emplace_back("nee", settings.next_event ? "on" : "off");
    add("roulette", settings.roulette);
    add("guiding", settings.guiding);
    add("learned mixture", settings.mixture.learned);
    add("bsdf-fraction", settings.mixture.bsdf_fraction);
    add("volumes", settings.field.volumes);
    add("field-budget", settings.field.budget_megabytes);
    add("bins", settings.field.bins);
    add("learning rate", settings.field.rate);
    add("learning target", settings.field.learning.target);
    add("learned light", settings.field.learning.light);
    add("uniform floor", settings.field.uniform_floor);
    add("precomputed samples", settings.field.precompute_samples);
    add("refinement", settings.field.refine_share);
    add("field", settings.field.representation);
    add("passes that learn", settings.learn_passes);
    return text;
}

}  // namespace pl
