// Meshes that a file shows more than once: whether loaders copy them or keep them once, and those that are kept.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

// Triangles of one description behind the triangles of another.

/// Moves the direct triangles of `added`, with their positions, colors, normals and texture coordinates, and its
/// warnings, behind the triangles and warnings of the scene. `added` has no meshes; its materials come from the
/// scene. Vertices of a part without colors become white if the other part has colors.
void append_triangles(SceneDescription added, SceneDescription& scene);

/// Most triangles and vertices that a glTF or Mitsuba file makes the program store, of meshes and of copies.
inline constexpr std::uint64_t kMostStoredTriangles = std::uint64_t{1} << 26;
inline constexpr std::uint64_t kMostStoredVertices = std::uint64_t{1} << 27;
/// Most places of meshes in a file.
inline constexpr std::uint64_t kMostInstances = std::uint64_t{1} << 26;

/// A mesh of a file, as far as it decides about copies.
struct MeshOutline {
    std::uint64_t triangles = 0;  ///< with an area, in the space of the mesh
    glm::dvec3 reach{0.0};        ///< the largest absolute coordinates of its vertices
    bool emits = false;           ///< one of its materials emits light
};

/// Decides about the meshes of a file, which have numbers there. Each place of a mesh is counted first; then the loader takes the places
/// in its order and asks for each whether it is an instance. Meshes are kept once if copies of all that are shown more than once
/// would have more triangles than a limit. Mirrored places show a mirror image of the mesh, a mesh of its own, so that instances do
/// not mirror. Copied nevertheless: meshes that emit, those that are shown once in an orientation, and places whose transformation
/// cannot be inverted in floats or leads out of the coordinates that files may have.
class KeptMeshes {
public:
    explicit KeptMeshes(std::uint64_t most_copied_triangles) : most_copied_(most_copied_triangles) {}

    void count(std::uint32_t mesh, const MeshOutline& outline, const glm::dmat4& to_world);
    /// The same for any order of places. Expects that all are counted.
    bool is_instance(std::uint32_t mesh, const MeshOutline& outline, const glm::dmat4& to_world) const;

    /// Adds the triangles of a mesh, transformed by an identity or mirror image, behind others.
    using AddMesh = std::function<void(const glm::dmat4& orientation, SceneDescription& to)>;
    /// Adds an instance in a place for which is_instance() is true. `add` is called at the first one of each orientation, and adds at
    /// least one triangle.
    void show(std::uint32_t mesh, const std::string& name, const glm::dmat4& to_world, const AddMesh& add);

    /// What is stored for the meshes.
    const SceneDescription& stored() const { return stored_; }
    /// Moves meshes and instances to a scene that has all its direct triangles. Leaves nothing.
    void move_to(SceneDescription& scene);

private:
    /// What is known of a mesh in each orientation: as it is, and mirrored.
    struct Use {
        std::array<std::uint64_t, 2> places{};
        std::array<std::optional<std::uint32_t>, 2> kept{};  ///< index into meshes
    };

    std::uint64_t most_copied_;
    std::uint64_t repeated_triangles_ = 0;  ///< of all places of meshes that may be kept
    std::map<std::uint32_t, Use> uses_;     ///< by the number of the mesh
    SceneDescription stored_;
};

// Meshes whose materials emit by a choice that was made after their file was read.

/// Replaces the instances of meshes with a material that emits by copies, behind the direct triangles and in the order of the instances:
/// lights are in the scene directly. Other meshes stay. Expects valid indices.
/// Throws Error(Input) if the scene would have more than kMostStoredTriangles.
void copy_emitting_meshes(SceneDescription& scene);

}  // namespace pl
