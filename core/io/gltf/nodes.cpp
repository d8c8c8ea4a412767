#include "core/io/gltf/nodes.h"

#include <algorithm>

#include <fmt/format.h>

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

    /// Replaces places relative to parents by those in the world.
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

}  // namespace pl
