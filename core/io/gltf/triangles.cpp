#include "core/io/gltf/triangles.h"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/io/gltf/accessors.h"
#include "core/io/gltf/primitives.h"
#include "core/io/kept_meshes.h"
#include "core/io/triangulate.h"
#include "core/scene/instances.h"

namespace pl {
namespace {

glm::dvec3 vector_at(const std::vector<float>& values, std::uint64_t i, double standard) {
    if (values.empty()) return glm::dvec3(standard);
    return glm::dvec3(glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]));
}

glm::dquat quaternion_at(const std::vector<float>& values, std::uint64_t i) {
    if (values.empty()) return {1.0, 0.0, 0.0, 0.0};
    const glm::dvec4 v(glm::vec4(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]));
    return {v.w, v.x, v.y, v.z};
}

}  // namespace

std::string gpu_instancing_at(std::uint32_t node) {
    return fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node);
}

GltfPlacements::GltfPlacements(GltfFile& file, std::uint32_t number, const GltfNode& node)
    : node_to_world_(node.to_world) {
    const std::string at = gpu_instancing_at(number);
    if (!file.json().has(at)) return;
    if (node.skin) {
        file.note("instances of meshes with skins are left out", at);
        return;
    }
    const std::string attributes = at + "/attributes";
    count_ = 0;
    moves_ = read(file, attributes + "/TRANSLATION", "VEC3");
    turns_ = read(file, attributes + "/ROTATION", "VEC4");
    scales_ = read(file, attributes + "/SCALE", "VEC3");
    if (count_ == 0) count_ = 1;
    for (std::uint64_t i = 0; i < count_; ++i) {
        if (!(glm::length(quaternion_at(turns_, i)) > 0.0)) {
            file.fail(attributes + "/ROTATION",
                      fmt::format("expected unit quaternions, got one of no length at instance {}", i));
        }
    }
}

glm::dmat4 GltfPlacements::to_world(std::uint64_t i) const {
    if (moves_.empty() && turns_.empty() && scales_.empty()) return node_to_world_;
    return node_to_world_ *
           transform_of(vector_at(moves_, i, 0.0), quaternion_at(turns_, i), vector_at(scales_, i, 1.0));
}

/// An attribute, which sets or has the number of places; nothing if there is none.
std::vector<float> GltfPlacements::read(GltfFile& file, const std::string& at, const char* type) {
    const std::optional<std::uint32_t> accessor = file.index(at, "accessors");
    if (!accessor) return {};
    const std::uint64_t count = accessor_count(file, *accessor);
    if (count > kMostInstances)
        file.fail(at, fmt::format("expected at most {} instances, got {}", kMostInstances, count));
    if (count_ != 0 && count != count_)
        file.fail(at, fmt::format("expected an element for each of {} instances, got {}", count_, count));
    count_ = count;
    return read_floats(file, *accessor, type);
}

namespace {

/// Places in the world of the joints of a skin, relative to their places when the mesh was bound to the skin.
std::vector<glm::dmat4> joint_transforms(GltfFile& file, const GltfNodes& nodes, std::uint32_t skin) {
    const std::string at = fmt::format("/skins/{}", skin);
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < file.json().array_size(at + "/joints"); ++i)
        joints.push_back(nodes.all[file.required_index(fmt::format("{}/joints/{}", at, i), "nodes")].to_world);
    const std::string bound_at = at + "/inverseBindMatrices";
    if (const auto accessor = file.index(bound_at, "accessors")) {
        const std::vector<float> bound = read_floats(file, *accessor, "MAT4");
        if (bound.size() < 16 * joints.size()) {
            file.fail(bound_at, fmt::format("expected a matrix for each of {} joints, got {}", joints.size(),
                                            bound.size() / 16));
        }
        for (std::size_t i = 0; i < joints.size(); ++i) {
            glm::dmat4 inverse;
            for (std::size_t k = 0; k < 16; ++k)
                inverse[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = static_cast<double>(bound[16 * i + k]);
            joints[i] = joints[i] * inverse;
        }
    }
    return joints;
}

class TriangleAdder {
public:
    TriangleAdder(GltfFile& file, const GltfNodes& nodes, std::vector<GltfSurface> surfaces, SceneDescription& scene,
                  std::uint64_t most_copied_triangles)
        : file_(file), nodes_(nodes), surfaces_(std::move(surfaces)), scene_(scene), meshes_(file, surfaces_, scene),
          kept_(most_copied_triangles) {}

    void run(MeshGroups* groups) {
        for_nodes([&](std::uint32_t number, const GltfNode& node) { count(number, node); });
        if (shown_triangles_ > kMostStoredTriangles) require_room();
        if (groups != nullptr) groups->names = {""};
        for_nodes([&](std::uint32_t number, const GltfNode& node) {
            add(number, node);
            if (groups == nullptr) return;
            groups->of_triangle.resize(scene_.triangles.size(), static_cast<std::uint32_t>(groups->names.size()));
            groups->names.push_back(node.name);
        });
        kept_.move_to(scene_);
        if (!scene_.vertex_colors.empty()) scene_.vertex_colors.resize(scene_.positions.size(), glm::vec3(1.0f));
    }

private:
    /// Calls fn(number, node) for the nodes that show a mesh.
    template <class Fn>
    void for_nodes(Fn&& fn) {
        for (const std::uint32_t number : nodes_.shown)
            if (nodes_.all[number].mesh) fn(number, nodes_.all[number]);
    }

    void count(std::uint32_t number, const GltfNode& node) {
        const MeshOutline& outline = outline_of(*node.mesh);
        const GltfPlacements placements(file_, number, node);
        places_ += placements.count();
        shown_triangles_ += placements.count() * outline.triangles;
        const std::string at = fmt::format("/nodes/{}", number);
        if (places_ > kMostInstances)
            file_.fail(at, fmt::format("expected at most {} places of meshes, got more", kMostInstances));
        if (shown_triangles_ > kMostShownTriangles) {
            file_.fail(at, fmt::format("expected at most {} triangles with those of every instance, got {} and more",
                                       kMostShownTriangles, shown_triangles_));
        }
        if (node.skin) return;
        for (std::uint64_t i = 0; i < placements.count(); ++i)
            kept_.count(*node.mesh, outline, placements.to_world(i));
    }

    const MeshOutline& outline_of(std::uint32_t mesh) {
        const auto [known, is_new] = outlines_.try_emplace(mesh);
        if (!is_new) return known->second;
        for (const GltfPrimitive& primitive : meshes_.mesh(mesh)) {
            if (primitive.triangles.empty()) continue;
            const std::vector<glm::vec3>& p = primitive.positions;
            for (const auto& corner : primitive.triangles)
                if (has_area(p[corner[0]], p[corner[1]], p[corner[2]])) ++known->second.triangles;
            for (const glm::vec3& position : p)
                known->second.reach = glm::max(known->second.reach, glm::dvec3(glm::abs(position)));
            if (scene_.materials[surfaces_[primitive.surface].material].emission != glm::vec3(0.0f))
                known->second.emits = true;
        }
        return known->second;
    }

    bool is_instance(const GltfNode& node, const glm::dmat4& to_world) {
        return !node.skin && kept_.is_instance(*node.mesh, outline_of(*node.mesh), to_world);
    }

    /// Refuses too many copies before they take memory.
    void require_room() {
        std::uint64_t triangles = 0;
        for_nodes([&](std::uint32_t number, const GltfNode& node) {
            const GltfPlacements placements(file_, number, node);
            for (std::uint64_t i = 0; i < placements.count(); ++i)
                if (!is_instance(node, placements.to_world(i))) triangles += outline_of(*node.mesh).triangles;
            if (triangles > kMostStoredTriangles) fail_full(fmt::format("/nodes/{}", number));
        });
    }

    [[noreturn]] void fail_full(const std::string& at) const {
        file_.fail(at, fmt::format("expected at most {} triangles in the scene, with all copies of meshes, got more",
                                   kMostStoredTriangles));
    }

    void add(std::uint32_t number, const GltfNode& node) {
        const GltfPlacements placements(file_, number, node);
        GltfPlace place;
        if (node.skin) place.joints = joint_transforms(file_, nodes_, *node.skin);
        for (std::uint64_t i = 0; i < placements.count(); ++i) {
            place.to_world = placements.to_world(i);
            if (is_instance(node, place.to_world))
                show(*node.mesh, place.to_world);
            else
                copy(*node.mesh, place, scene_);
        }
    }

    void show(std::uint32_t mesh, const glm::dmat4& to_world) {
        kept_.show(mesh, file_.name_of(fmt::format("/meshes/{}", mesh), "mesh", mesh), to_world,
                   [&](const glm::dmat4& orientation, SceneDescription& to) { copy(mesh, {orientation}, to); });
    }

    void copy(std::uint32_t mesh, const GltfPlace& place, SceneDescription& to) {
        for (const GltfPrimitive& primitive : meshes_.mesh(mesh)) {
            const SceneDescription& kept = kept_.stored();
            const std::size_t triangles = scene_.triangles.size() + kept.triangles.size();
            const std::size_t vertices = scene_.positions.size() + kept.positions.size();
            if (triangles + primitive.triangles.size() > kMostStoredTriangles ||
                vertices + primitive.positions.size() > kMostStoredVertices)
                fail_full(primitive.at);
            copy_gltf_primitive(file_, primitive, surfaces_[primitive.surface].material, place, to);
        }
    }

    GltfFile& file_;
    const GltfNodes& nodes_;
    std::vector<GltfSurface> surfaces_;
    SceneDescription& scene_;
    GltfMeshes meshes_;
    KeptMeshes kept_;
    std::map<std::uint32_t, MeshOutline> outlines_;  ///< by the number of the mesh
    std::uint64_t places_ = 0, shown_triangles_ = 0;
};

}  // namespace

void add_gltf_triangles(GltfFile& file, const GltfNodes& nodes, std::vector<GltfSurface> surfaces,
                        SceneDescription& scene, MeshGroups* groups, std::uint64_t most_copied_triangles) {
    // A knob that moves a group would move every instance of its mesh.
    const std::uint64_t most = groups == nullptr ? most_copied_triangles : std::numeric_limits<std::uint64_t>::max();
    TriangleAdder(file, nodes, std::move(surfaces), scene, most).run(groups);
}

}  // namespace pl
