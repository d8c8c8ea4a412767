// Instances of a Mitsuba scene: groups of shapes that it shows any number of times.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/io/kept_meshes.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The triangles of a `shapegroup`, with materials of the scene.
struct MitsubaGroup {
    std::uint32_t number = 0;  ///< among the groups of the scene
    std::string name{};
    SceneDescription shapes{};
    MeshOutline outline{};
};

MeshOutline outline_of(const SceneDescription& shapes, const std::vector<MaterialDescription>& materials);

/// Collects the `instance` elements of a scene while its other shapes are read. When all are known, KeptMeshes decides about each: its
/// group is copied in the order of the file, or kept behind all direct triangles.
class MitsubaInstances {
public:
    explicit MitsubaInstances(std::uint64_t most_copied_triangles) : kept_(most_copied_triangles) {}

    /// Takes the triangles that the scene has so far, which come before the triangles of the instance. `group` stays
    /// where it is. Throws Error(Input) for more than kMostInstances or kMostShownTriangles.
    void add(const MitsubaObject& instance, const MitsubaGroup& group, SceneDescription& scene);

    /// Gives the scene, which has the triangles behind the last instance, the triangles before and the triangles of
    /// all instances. Throws Error(Input) at an instance: more than kMostStoredTriangles or kMostStoredVertices,
    /// coordinates beyond kLargestCoordinate.
    void move_to(SceneDescription& scene);

private:
    struct Shown {
        MitsubaObject instance;
        const MitsubaGroup* group;
        glm::dmat4 to_world;  ///< from the origin of the scene
    };

    void require_room() const;
    void place(const Shown& shown, SceneDescription& scene);

    KeptMeshes kept_;
    std::vector<Shown> shown_;
    std::map<std::size_t, SceneDescription>
        before_;  ///< triangles before the instance of this number, if there are some
    std::uint64_t shown_triangles_ = 0;
};

}  // namespace pl
