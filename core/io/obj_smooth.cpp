#include "core/io/obj_smooth.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pl {
namespace {

/// Calls visit(corners) for every face of a smoothing group of whose corners none has a normal.
template <class Visit>
void for_each_smooth_face(ObjMesh& mesh, Visit&& visit) {
    for (ObjFaces& part : mesh.parts) {
        std::size_t first = 0;
        for (std::size_t run = 0; run < part.runs.size(); ++run) {
            for (std::size_t face = part.runs[run].first; face < part.end_of(run); ++face) {
                const std::span<ObjCorner> corners(part.corners.data() + first, part.corner_counts[face]);
                first += corners.size();
                const auto has_none = [](const ObjCorner& corner) { return corner.normal == ObjCorner::kNone; };
                if (part.runs[run].smoothing == Smoothing::On &&
                    std::all_of(corners.begin(), corners.end(), has_none))
                    visit(corners);
            }
        }
    }
}

bool has_smooth_runs(const ObjMesh& mesh) {
    return std::any_of(mesh.parts.begin(), mesh.parts.end(), [](const ObjFaces& part) {
        return std::any_of(part.runs.begin(), part.runs.end(),
                           [](const ObjFaces::Run& run) { return run.smoothing == Smoothing::On; });
    });
}

/// A unit vector, or 0.
glm::dvec3 direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

/// Sums of the normals around each vertex.
class NormalSums {
public:
    explicit NormalSums(const std::vector<glm::vec3>& positions) : positions_(positions), sums_(positions.size()) {}

    void add(std::span<const ObjCorner> corners) {
        const std::size_t count = corners.size();
        glm::dvec3 area(0.0);
        for (std::size_t i = 1; i + 1 < count; ++i)
            area += glm::cross(at(corners[i]) - at(corners[0]), at(corners[i + 1]) - at(corners[0]));
        const glm::dvec3 normal = direction(area);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 to_next = direction(at(corners[(i + 1) % count]) - at(corners[i]));
            const glm::dvec3 to_last = direction(at(corners[(i + count - 1) % count]) - at(corners[i]));
            const double angle = std::acos(std::clamp(glm::dot(to_next, to_last), -1.0, 1.0));
            sums_[corners[i].vertex] += angle * normal;
        }
    }

    glm::vec3 normal(std::uint32_t vertex) const { return glm::vec3(direction(sums_[vertex])); }

private:
    glm::dvec3 at(const ObjCorner& corner) const { return glm::dvec3(positions_[corner.vertex]); }

    const std::vector<glm::vec3>& positions_;
    std::vector<glm::dvec3> sums_;
};

}  // namespace

void smooth_normals(ObjMesh& mesh) {
    if (!has_smooth_runs(mesh)) return;
    NormalSums sums(mesh.positions);
    for_each_smooth_face(mesh, [&](std::span<ObjCorner> corners) { sums.add(corners); });
    std::vector<std::uint32_t> number(mesh.positions.size(), ObjCorner::kNone);
    for_each_smooth_face(mesh, [&](std::span<ObjCorner> corners) {
        for (ObjCorner& corner : corners) {
            std::uint32_t& normal = number[corner.vertex];
            if (normal == ObjCorner::kNone) {
                normal = static_cast<std::uint32_t>(mesh.normals.size());
                mesh.normals.push_back(sums.normal(corner.vertex));
            }
            corner.normal = normal;
        }
    });
}

}  // namespace pl
