#include "core/io/gltf/nodes.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/scene/pack_scene.h"
#include "core/scene/punctual_lights.h"

namespace pl {
namespace {

constexpr std::uint32_t kNoParent = 0xffffffffu;

std::string node_at(std::uint32_t node) { return fmt::format("/nodes/{}", node); }

/// Place relative to the parent. [glTF 2.0, section 3.5.3]
glm::dmat4 local_transform(const JsonDocument& json, const std::string& at) {
    if (const auto given = json.numbers(at + "/matrix", 16)) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*given)[static_cast<std::size_t>(i)];
        return matrix;
    }
    const auto vector = [&](const char* member, const glm::dvec3& standard) {
        const auto given = json.numbers(at + member, 3);
        return given ? glm::dvec3((*given)[0], (*given)[1], (*given)[2]) : standard;
    };
    glm::dquat turn(1.0, 0.0, 0.0, 0.0);
    if (const auto given = json.numbers(at + "/rotation", 4)) {
        turn = glm::dquat((*given)[3], (*given)[0], (*given)[1], (*given)[2]);
        if (!(glm::length(turn) > 0.0))
            json.fail(at + "/rotation", "expected a unit quaternion, got one of no length");
    }
    return transform_of(vector("/translation", glm::dvec3(0.0)), turn, vector("/scale", glm::dvec3(1.0)));
}

/// Reads the forest of nodes.
class NodeReader {
public:
    explicit NodeReader(const GltfFile& file) : file_(file), count_(file.json().array_size("/nodes")) {}

    GltfNodes run() {
        read_parents();
        GltfNodes nodes;
        for (std::uint32_t i = 0; i < count_; ++i) nodes.all.push_back(read_node(i));
        std::vector<std::uint32_t> roots;
        for (std::uint32_t i = 0; i < count_; ++i)
            if (parent_[i] == kNoParent) roots.push_back(i);
        place(roots, nodes.all);
        nodes.shown = below(shown_roots(roots));
        return nodes;
    }

private:
    void read_parents() {
        parent_.assign(count_, kNoParent);
        children_.resize(count_);
        for (std::uint32_t i = 0; i < count_; ++i) {
            const std::string at = node_at(i) + "/children";
            for (std::size_t c = 0; c < file_.json().array_size(at); ++c) {
                const std::string pointer = fmt::format("{}/{}", at, c);
                const std::uint32_t child = file_.required_index(pointer, "nodes");
                if (parent_[child] != kNoParent) {
                    file_.fail(pointer, fmt::format("expected a node without another parent, got node {}, a child of "
                                                    "node {}",
                                                    child, parent_[child]));
                }
                parent_[child] = i;
                children_[i].push_back(child);
            }
        }
    }

    GltfNode read_node(std::uint32_t number) const {
        const std::string at = node_at(number);
        GltfNode node{.name = file_.name_of(at, "node", number), .to_world = local_transform(file_.json(), at)};
        node.mesh = file_.index(at + "/mesh", "meshes");
        node.camera = file_.index(at + "/camera", "cameras");
        node.skin = file_.index(at + "/skin", "skins");
        node.light =
            file_.index(at + "/extensions/KHR_lights_punctual/light", "extensions/KHR_lights_punctual/lights");
        return node;
    }

    /// Replaces places relative to parents by places in the world.
    void place(const std::vector<std::uint32_t>& roots, std::vector<GltfNode>& nodes) const {
        const std::vector<std::uint32_t> reached = below(roots);
        for (const std::uint32_t i : reached)
            if (parent_[i] != kNoParent) nodes[i].to_world = nodes[parent_[i]].to_world * nodes[i].to_world;
        if (reached.size() < count_) {
            std::vector<bool> is_reached(count_, false);
            for (const std::uint32_t i : reached) is_reached[i] = true;
            const auto first = std::find(is_reached.begin(), is_reached.end(), false) - is_reached.begin();
            file_.fail(node_at(static_cast<std::uint32_t>(first)),
                       "expected a tree of nodes, got a circle: this node is above itself");
        }
    }

    /// The nodes of trees, each before its children, in the order of the file.
    std::vector<std::uint32_t> below(const std::vector<std::uint32_t>& roots) const {
        std::vector<std::uint32_t> order;
        std::vector<std::uint32_t> open(roots.rbegin(), roots.rend());
        while (!open.empty()) {
            const std::uint32_t node = open.back();
            open.pop_back();
            order.push_back(node);
            open.insert(open.end(), children_[node].rbegin(), children_[node].rend());
        }
        return order;
    }

    /// Roots of the scene to show; without scenes all.
    std::vector<std::uint32_t> shown_roots(const std::vector<std::uint32_t>& roots) const {
        if (file_.json().array_size("/scenes") == 0) return roots;
        const std::uint32_t scene = file_.index("/scene", "scenes").value_or(0);
        const std::string at = fmt::format("/scenes/{}/nodes", scene);
        std::vector<std::uint32_t> shown;
        std::vector<bool> is_shown(count_, false);
        for (std::size_t i = 0; i < file_.json().array_size(at); ++i) {
            const std::string pointer = fmt::format("{}/{}", at, i);
            const std::uint32_t node = file_.required_index(pointer, "nodes");
            if (is_shown[node] || parent_[node] != kNoParent)
                file_.fail(pointer, fmt::format("expected nodes without parents, each once, got node {}", node));
            is_shown[node] = true;
            shown.push_back(node);
        }
        return shown;
    }

    const GltfFile& file_;
    std::size_t count_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::vector<std::uint32_t>> children_;
};

}  // namespace

glm::dmat4 transform_of(const glm::dvec3& move, const glm::dquat& turn, const glm::dvec3& scale) {
    glm::dmat4 matrix = glm::mat4_cast(glm::normalize(turn));
    for (int i = 0; i < 3; ++i) matrix[i] *= scale[i];
    matrix[3] = glm::dvec4(move, 1.0);
    return matrix;
}

GltfNodes read_nodes(const GltfFile& file, const glm::dvec3& origin) {
    GltfNodes nodes = NodeReader(file).run();
    for (GltfNode& node : nodes.all) node.to_world[3] -= glm::dvec4(origin, 0.0);
    return nodes;
}

namespace {

/// Distance to a target within or before the scene, so far that eye and target differ as floats.
double target_distance(const Bounds& bounds, const glm::dvec3& eye, const glm::dvec3& forward) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 high(bounds.high);
    const double to_center = glm::dot(0.5 * (low + high) - eye, forward);
    const double size = glm::length(high - low);
    const glm::dvec3 away = glm::abs(eye);
    const double least =
        64.0 * std::max({away.x, away.y, away.z}) * static_cast<double>(std::numeric_limits<float>::epsilon());
    return std::max({to_center, 0.1 * size, least});
}

/// A camera looks along -z of its node. [glTF 2.0, section 3.10]
std::optional<CameraDescription> place_camera(const GltfNode& node, float fov_deg, const Bounds& bounds) {
    const glm::dvec3 back(node.to_world[2]);
    const glm::dvec3 up(node.to_world[1]);
    if (!(glm::length(back) > 0.0) || !(glm::length(up) > 0.0)) return std::nullopt;
    const glm::dvec3 eye(node.to_world[3]);
    const glm::dvec3 forward = -glm::normalize(back);
    const double distance = target_distance(bounds, eye, forward);
    CameraDescription camera;
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(eye + distance * forward);
    camera.up = glm::vec3(glm::normalize(up));
    camera.fov_deg = fov_deg;
    camera.focus_distance = static_cast<float>(distance);
    return camera;
}

/// Full vertical angle in degrees.
float field_of_view(const GltfFile& file, const std::string& at) {
    const std::string pointer = at + "/perspective/yfov";
    const double radians = static_cast<double>(file.json().number(pointer).value_or(0.0f));
    if (!(radians > 0.0 && radians < glm::pi<double>()))
        file.fail(pointer, fmt::format("expected an angle within (0, pi) radians, got {}", radians));
    return std::min(static_cast<float>(radians * 180.0 / glm::pi<double>()), 179.9f);
}

}  // namespace

void add_gltf_cameras(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene) {
    const Bounds bounds = bounds_of(scene);
    for (const std::uint32_t number : nodes.shown) {
        const GltfNode& node = nodes.all[number];
        if (!node.camera) continue;
        const std::string at = fmt::format("/cameras/{}", *node.camera);
        if (file.json().text(at + "/type") != "perspective") {
            file.note("cameras without perspective are left out", at);
            continue;
        }
        const std::optional<CameraDescription> camera = place_camera(node, field_of_view(file, at), bounds);
        if (!camera) {
            file.note("cameras whose node has no extent are left out", at);
            continue;
        }
        scene.cameras.push_back({.name = node.name,
                                 .camera = *camera,
                                 .aspect = file.json().number(at + "/perspective/aspectRatio").value_or(0.0f)});
    }
}

namespace {

/// Lumens of a watt in files of Blender's exporter, in its default unit.
constexpr double kLumensPerWatt = 683.0;

/// Radiant intensity of points and spots, irradiance of directional lights.
glm::vec3 intensity_of(GltfFile& file, const std::string& at) {
    const double intensity = static_cast<double>(file.json().number(at + "/intensity").value_or(1.0f));
    const auto color = file.json().numbers(at + "/color", 3);
    const glm::dvec3 tint = color ? glm::dvec3((*color)[0], (*color)[1], (*color)[2]) : glm::dvec3(1.0);
    if (!(intensity >= 0.0) || glm::any(glm::lessThan(tint, glm::dvec3(0.0))))
        file.fail(at, "expected a color and an intensity of at least 0");
    const bool is_of_blender = file.json().text("/asset/generator").value_or("").find("Blender") != std::string::npos;
    return glm::vec3(tint * intensity / (is_of_blender ? kLumensPerWatt : 1.0));
}

/// False if the light has no cone. Cones that glTF does not allow have a meaning nevertheless: the falloff is one of the
/// cosine, for any angle.
bool read_cones(GltfFile& file, const std::string& at, PunctualLightDescription& light) {
    const float inner = file.json().number(at + "/spot/innerConeAngle").value_or(0.0f);
    const float outer = file.json().number(at + "/spot/outerConeAngle").value_or(glm::quarter_pi<float>());
    light.outer_deg = std::min(glm::degrees(outer), kMostSpotAngle);
    light.inner_deg = std::clamp(glm::degrees(inner), 0.0f, std::max(light.outer_deg, 0.0f));
    if (outer > glm::pi<float>() || !(inner >= 0.0f && inner <= outer))
        file.note("cones of spots are moved to 0 <= innerConeAngle <= outerConeAngle <= pi", at);
    light.falloff = SpotFalloff::Cosine;
    return light.outer_deg > 0.0f;
}

/// A light shines along -z of its node.
void add_light(GltfFile& file, const GltfNode& node, const std::string& at, SceneDescription& scene) {
    const std::string type = file.json().text(at + "/type").value_or("none");
    const auto kind = choice_named<PunctualKind>(type);
    if (!kind) return file.note(fmt::format("lights of the type {} are left out", type), at);
    const glm::dvec3 back(node.to_world[2]);
    if (*kind != PunctualKind::Point && !(glm::length(back) > 0.0))
        return file.note("lights whose node has no extent are left out", at);
    PunctualLightDescription light{.kind = *kind, .position = glm::vec3(node.to_world[3])};
    light.intensity = intensity_of(file, at);
    if (*kind != PunctualKind::Point) light.direction = glm::vec3(-glm::normalize(back));
    if (*kind == PunctualKind::Spot && !read_cones(file, at, light))
        return file.note("spots without a cone are left out", at);
    if (*kind != PunctualKind::Directional && file.json().number(at + "/range"))
        file.note("ranges of lights are left out: light falls off by the square of the distance alone", at);
    scene.punctual_lights.push_back(light);
}

}  // namespace

void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene) {
    for (const std::uint32_t number : nodes.shown) {
        const GltfNode& node = nodes.all[number];
        if (node.light)
            add_light(file, node, fmt::format("/extensions/KHR_lights_punctual/lights/{}", *node.light), scene);
    }
}

}  // namespace pl
