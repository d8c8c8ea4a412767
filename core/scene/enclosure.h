// Surfaces without a border: whoever is inside one sees no way out, so that a path that leaves was lost.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// The closed surfaces of a scene: connected triangles that no light passes through, of which every edge belongs to an even
/// number. Corners at the same place count as one, whatever their numbers are.
class Enclosure {
public:
    /// Takes time and memory like sorting all edges.
    explicit Enclosure(const SceneDescription& scene);

    /// Is the point inside one of them, by the parity of what a ray from there crosses?
    bool contains(glm::vec3 point) const;

    std::size_t surface_count() const { return surfaces_.size(); }

private:
    struct Face {
        glm::dvec3 a;
        glm::dvec3 b;
        glm::dvec3 c;
    };

    struct Surface {
        std::size_t end;  ///< of its faces, which begin where those of the one before end
        glm::dvec3 low;   ///< of its bounds
        glm::dvec3 high;
    };

    std::vector<Face> faces_;
    std::vector<Surface> surfaces_;
};

}  // namespace pl
