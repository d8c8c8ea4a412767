#include "core/io/scene_knobs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/io/line_reader.h"
#include "core/io/nearest_name.h"

namespace pl {

namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

/// The vertices and normals of some groups, as flags.
struct MeshSelection {
    std::vector<bool> vertices;
    std::vector<bool> normals;
};

/// Reads, checks and applies the motions of a knob, one at a time.
class MotionReader {
public:
    MotionReader(const JsonDocument& file, SceneDescription& scene, const MeshGroups& groups,
                 const KnobDescription& knob)
        : file_(file), scene_(scene), groups_(groups), knob_(knob) {}

    void move(const std::string& at) {
        file_.object(at, {"groups", "by"});
        const MeshSelection what = select(at);
        const glm::dvec3 step = turned() * required(at, "by");
        apply(
            what, [&](const glm::dvec3& p) { return p + step; }, [](const glm::dvec3& n) { return n; });
    }

    void turn(const std::string& at) {
        file_.object(at, {"groups", "about", "axis", "by_deg"});
        const MeshSelection what = select(at);
        const glm::dvec3 about = required(at, "about", &JsonDocument::point);
        const glm::dvec3 axis = required(at, "axis");
        const std::optional<float> by_deg = file_.number(at + "/by_deg");
        if (!(glm::length(axis) > 0.0)) {
            file_.fail(at + "/axis", "expected a direction, got no length");
        }
        if (!by_deg) {
            file_.fail(at + "/groups", "expected 'by_deg', degrees per unit of the knob, beside it");
        }
        const double angle = turned() * static_cast<double>(*by_deg) * kRadiansPerDegree;
        const glm::dmat3 rotation(glm::rotate(glm::dmat4(1.0), angle, axis));
        apply(
            what, [&](const glm::dvec3& p) { return about + rotation * (p - about); },
            [&](const glm::dvec3& n) { return rotation * n; });
    }

    void scale(const std::string& at) {
        file_.object(at, {"groups", "about", "by"});
        const MeshSelection what = select(at);
        const glm::dvec3 about = required(at, "about", &JsonDocument::point);
        const glm::dvec3 by = required(at, "by");
        for (const float end : {knob_.low, knob_.high}) {
            if (!glm::all(glm::greaterThan(factor_at(by, end), glm::dvec3(0.0)))) {
                file_.fail(at + "/by", fmt::format("nothing is left of the group at the value {}", end));
            }
        }
        const glm::dvec3 factor = factor_at(by, knob_.value);
        apply(
            what, [&](const glm::dvec3& p) { return about + factor * (p - about); },
            [&](const glm::dvec3& n) { return glm::normalize(n / factor); });
    }

private:
    double turned() const { return static_cast<double>(knob_.value) - static_cast<double>(knob_.default_value); }

    glm::dvec3 factor_at(const glm::dvec3& by, float value) const {
        return 1.0 + (static_cast<double>(value) - static_cast<double>(knob_.default_value)) * by;
    }

    using Read = std::optional<glm::vec3> (JsonDocument::*)(const std::string&) const;

    glm::dvec3 required(const std::string& at, const char* key, Read read = &JsonDocument::vector) const {
        const std::optional<glm::vec3> value = (file_.*read)(at + "/" + key);
        if (!value) {
            file_.fail(at + "/groups", fmt::format("expected '{}' [x, y, z] beside it", key));
        }
        return glm::dvec3(*value);
    }

    MeshSelection select(const std::string& at) const {
        const auto names = file_.texts(at + "/groups");
        if (!names) {
            file_.fail(at.substr(0, at.rfind('/')), "expected objects { ... } with 'groups'");
        }
        std::vector<bool> moved(groups_.names.size(), false);
        for (const std::string& name : *names) {
            const auto found = std::find(groups_.names.begin(), groups_.names.end(), name);
            if (found == groups_.names.end()) {
                file_.fail(at + "/groups", fmt::format("the mesh has no group {}{}", in_quotes(name),
                                                       did_you_mean(name, groups_.names)));
            }
            moved[static_cast<std::size_t>(found - groups_.names.begin())] = true;
        }
        MeshSelection what{.vertices = std::vector<bool>(scene_.positions.size(), false),
                           .normals = std::vector<bool>(scene_.normals.size(), false)};
        for_corners(moved, true, [&](std::uint32_t, std::uint32_t vertex, std::uint32_t normal) {
            what.vertices[vertex] = true;
            if (normal != TriangleDescription::kNoNormal) what.normals[normal] = true;
        });
        for_corners(moved, false, [&](std::uint32_t group, std::uint32_t vertex, std::uint32_t normal) {
            const bool vertex_shared = what.vertices[vertex];
            if (vertex_shared || (normal != TriangleDescription::kNoNormal && what.normals[normal]))
                file_.fail(at + "/groups",
                           fmt::format("expected groups that move alone: {} {} is also used by group {}, which stays",
                                       vertex_shared ? "vertex" : "normal", 1 + (vertex_shared ? vertex : normal),
                                       in_quotes(groups_.names[group])));
        });
        return what;
    }

    /// Calls fn(group, vertex, normal) for the corners of all triangles whose group is, or is not, in the motion.
    template <typename Fn>
    void for_corners(const std::vector<bool>& moved, bool wanted, Fn&& fn) const {
        for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
            const std::uint32_t group = groups_.of_triangle[i];
            if (moved[group] != wanted) continue;
            for (int k = 0; k < 3; ++k) fn(group, scene_.triangles[i].vertex[k], scene_.triangles[i].normal[k]);
        }
    }

    /// Skipped for a knob at its default, where rounding would change bits.
    template <typename Point, typename Normal>
    void apply(const MeshSelection& what, Point&& point, Normal&& normal) {
        if (knob_.value == knob_.default_value) return;
        for (std::size_t i = 0; i < scene_.positions.size(); ++i)
            if (what.vertices[i]) scene_.positions[i] = glm::vec3(point(glm::dvec3(scene_.positions[i])));
        for (std::size_t i = 0; i < scene_.normals.size(); ++i)
            if (what.normals[i]) scene_.normals[i] = glm::vec3(normal(glm::dvec3(scene_.normals[i])));
    }

    const JsonDocument& file_;
    SceneDescription& scene_;
    const MeshGroups& groups_;
    const KnobDescription& knob_;
};

void set_albedo(const JsonDocument& file, const std::string& at, SceneDescription& scene,
                const KnobDescription& knob) {
    const std::vector<std::string> names = file.texts(at).value();
    for (const std::string& name : names) {
        const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                           [&](const MaterialDescription& m) { return m.name == name; });
        if (material == scene.materials.end()) {
            file.fail(at, fmt::format("the scene has no material {}", in_quotes(name)));
        }
        if (material->albedo != glm::vec3(knob.default_value)) {
            file.fail(at,
                      fmt::format("expected the default to be the albedo of {}, got {} and {} {} {}", in_quotes(name),
                                  knob.default_value, material->albedo.x, material->albedo.y, material->albedo.z));
        }
        material->albedo = glm::vec3(knob.value);
    }
    if (knob.low < 0.0f || knob.high > 1.0f) {
        file.fail(at, fmt::format("expected a range within [0, 1], got [{}, {}]", knob.low, knob.high));
    }
}

/// The requested value, or the default. Throws Error(Usage) for one that is no number in the range.
float value_of(const KnobDescription& knob, const ParameterTexts& asked) {
    const auto last =
        std::find_if(asked.rbegin(), asked.rend(), [&](const auto& given) { return given.first == knob.name; });
    if (last == asked.rend()) return knob.default_value;
    const std::optional<double> number = parse_number(last->second);
    const auto value = static_cast<float>(number.value_or(0.0));
    if (!number || !(value >= knob.low && value <= knob.high)) {
        throw Error(ErrorKind::Usage, fmt::format("-D {}: expected a number from {} to {} ({}), got '{}'", knob.name,
                                                  knob.low, knob.high, knob.does, last->second));
    }
    return value;
}

KnobDescription read_knob(const JsonDocument& file, const std::string& name, const ParameterTexts& asked) {
    const std::string at = "/knobs" + pointer_step(name);
    file.object(at, {"default", "range", "does", "moves", "turns", "scales", "albedo"});
    const std::optional<float> default_value = file.number(at + "/default");
    const std::optional<glm::vec2> range = file.range(at + "/range");
    const std::optional<std::string> does = file.text(at + "/does");
    if (!default_value || !range || !does) {
        file.fail(at, "expected 'default', 'range' [low, high] and 'does'");
    }
    if (name.empty() || name.find_first_of("=,") != std::string::npos) {
        file.fail(at, "expected a name without '=' and ','");
    }
    if (!(*default_value >= range->x && *default_value <= range->y)) {
        file.fail(at + "/default",
                  fmt::format("expected a number within [{}, {}], got {}", range->x, range->y, *default_value));
    }
    KnobDescription knob{
        .name = name, .does = *does, .low = range->x, .high = range->y, .default_value = *default_value};
    knob.value = value_of(knob, asked);
    return knob;
}

void apply_knob(const JsonDocument& file, SceneDescription& scene, const MeshGroups& groups,
                const KnobDescription& knob) {
    const std::string at = "/knobs" + pointer_step(knob.name);
    MotionReader motions(file, scene, groups, knob);
    const auto for_each = [&](const char* key, void (MotionReader::*apply)(const std::string&)) {
        const std::size_t count = file.array_size(at + key);
        for (std::size_t i = 0; i < count; ++i) (motions.*apply)(fmt::format("{}{}/{}", at, key, i));
        return count > 0;
    };
    const bool moves = for_each("/moves", &MotionReader::move);
    const bool turns = for_each("/turns", &MotionReader::turn);
    const bool scales = for_each("/scales", &MotionReader::scale);
    const bool colors = file.array_size(at + "/albedo") > 0;
    if (colors) set_albedo(file, at + "/albedo", scene, knob);
    if (!moves && !turns && !scales && !colors) {
        file.fail(at, "the knob does nothing: expected 'moves', 'turns', 'scales' or 'albedo'");
    }
}

}  // namespace

void read_knobs(const JsonDocument& file, SceneDescription& scene, const MeshGroups& groups,
                const ParameterTexts& asked) {
    const auto all = file.root().find("knobs");
    if (all != file.root().end() && !all->is_object()) {
        file.fail("/knobs", "expected an object { ... }");
    }
    if (all != file.root().end()) {
        for (const auto& [name, member] : all->items()) {
            scene.knobs.push_back(read_knob(file, name, asked));
            apply_knob(file, scene, groups, scene.knobs.back());
        }
    }
}

void require_known_knobs(const SceneDescription& scene, const ParameterTexts& asked) {
    std::vector<std::string> known;
    for (const KnobDescription& knob : scene.knobs) known.push_back(knob.name);
    for (const auto& [name, value] : asked) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error(ErrorKind::Usage, fmt::format("-D {}: {} has no such knob{}", name, scene.source.string(),
                                                  known.empty() ? ": it has none" : known_names(name, known)));
    }
}

}  // namespace pl
