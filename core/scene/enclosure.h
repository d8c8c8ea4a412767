// Closed surfaces: a ray that starts inside of one and escapes has leaked.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// The closed opaque surfaces of a scene without its instances: connected components of direct triangles in which an even number of
/// triangles share every edge. Vertices at equal positions count as one.
class Enclosure {
public:
    /// Time and memory of a sort of all edges.
    explicit Enclosure(const SceneDescription& scene);

    /// Whether the point is inside of a closed surface, by the parity of the intersections of a ray.
    bool contains(glm::vec3 point) const;

private:
    struct Face {
        glm::dvec3 a;
        glm::dvec3 b;
        glm::dvec3 c;
    };

    struct Surface {
        std::size_t end;  ///< end of its faces; they begin at the end of the previous surface
        glm::dvec3 low;   ///< bounds
        glm::dvec3 high;
    };

    std::vector<Face> faces_;
    std::vector<Surface> surfaces_;
};

}  // namespace pl
