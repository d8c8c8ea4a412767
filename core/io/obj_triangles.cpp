#include "core/io/obj_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>

#include "core/base/parallel.h"
#include "core/io/tally.h"
#include "core/io/triangulate.h"

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

namespace {

static_assert(ObjCorner::kNone == TriangleDescription::kNoNormal && ObjCorner::kNone == TriangleDescription::kNoUv);

void make_unit(std::vector<glm::vec3>& normals, ObjNormals lengths, int threads) {
    constexpr double kRounding = 1e-6;
    for_indices(static_cast<std::uint32_t>(normals.size()), threads, [&](std::uint32_t i) {
        const glm::dvec3 normal(normals[i]);
        const double length = glm::length(normal);
        if (lengths == ObjNormals::Unit && std::abs(length - 1.0) < kRounding) return;
        normals[i] = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
    });
}

/// Makes the triangles of consecutive faces, in a part of the scene's arrays that is large enough for all of them.
class PartBuilder {
public:
    PartBuilder(const SceneDescription& scene, const ObjFaces& faces, const MaterialTable& materials,
                TriangleDescription* triangles, std::uint32_t* groups)
        : scene_(scene), faces_(faces), materials_(materials), triangles_(triangles), groups_(groups) {}

    void build() {
        std::vector<glm::vec3> outline;
        const ObjCorner* corners = faces_.corners.data();
        for (std::size_t run = 0; run < faces_.runs.size(); ++run) {
            material_ = materials_.of(faces_.runs[run]);
            group_ = faces_.runs[run].group;
            for (face_ = faces_.runs[run].first; face_ < faces_.end_of(run); ++face_) {
                const std::uint32_t corner_count = faces_.corner_counts[face_];
                if (corner_count == 3) {
                    add_triangle(corners[0], corners[1], corners[2]);
                } else {
                    cut({corners, corner_count}, outline);
                }
                corners += corner_count;
            }
        }
    }

    std::size_t count = 0;  ///< of the triangles
    Tally crossed;
    Tally no_area;
    Tally no_normal;

private:
    void cut(std::span<const ObjCorner> corners, std::vector<glm::vec3>& outline) {
        outline.clear();
        for (const ObjCorner& corner : corners) {
            outline.push_back(scene_.positions[corner.vertex]);
        }
        const Triangulation result = triangulate(outline);
        if (!result.exact) {
            crossed.add(faces_.lines[face_]);
        }
        for (const auto& [a, b, c] : result.triangles) {
            add_triangle(corners[a], corners[b], corners[c]);
        }
    }

    void add_triangle(const ObjCorner& a, const ObjCorner& b, const ObjCorner& c) {
        TriangleDescription triangle{.vertex = {a.vertex, b.vertex, c.vertex}, .material = material_};
        if (!has_area(scene_.positions[a.vertex], scene_.positions[b.vertex], scene_.positions[c.vertex])) {
            no_area.add(faces_.lines[face_]);
            return;
        }
        if (is_usable(a.normal) && is_usable(b.normal) && is_usable(c.normal)) {
            triangle.normal = {a.normal, b.normal, c.normal};
        } else if ((a.normal & b.normal & c.normal) != ObjCorner::kNone) {
            no_normal.add(faces_.lines[face_]);
        }
        if (a.uv != ObjCorner::kNone && b.uv != ObjCorner::kNone && c.uv != ObjCorner::kNone) {
            triangle.uv = {a.uv, b.uv, c.uv};
        }
        if (groups_ != nullptr) {
            groups_[count] = group_;
        }
        triangles_[count++] = triangle;
    }

    bool is_usable(std::uint32_t normal) const {
        return normal != ObjCorner::kNone && scene_.normals[normal] != glm::vec3(0.0f);
    }

    const SceneDescription& scene_;
    const ObjFaces& faces_;
    const MaterialTable& materials_;
    TriangleDescription* triangles_;
    std::uint32_t* groups_;
    std::size_t face_ = 0;
    std::uint32_t material_ = 0;
    std::uint32_t group_ = 0;
};

/// Closes the gaps that removed triangles have left behind the parts.
template <class T>
void close_gaps(std::vector<T>& values, const std::vector<std::size_t>& first,
                const std::vector<PartBuilder>& parts) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (end != first[i]) {
            const auto from = values.begin() + static_cast<std::ptrdiff_t>(first[i]);
            std::copy_n(from, parts[i].count, values.begin() + static_cast<std::ptrdiff_t>(end));
        }
        end += parts[i].count;
    }
    values.resize(end);
}

/// Gives triangles whose images are elsewhere texture points of their own.
void scale_uvs(SceneDescription& scene, const std::vector<UvScale>& uvs) {
    std::unordered_map<std::uint64_t, std::uint32_t> scaled;  // by material and texture point
    for (TriangleDescription& triangle : scene.triangles) {
        if (triangle.material >= uvs.size() || uvs[triangle.material] == UvScale{} || !triangle.has_uvs()) continue;
        const UvScale& to = uvs[triangle.material];
        for (int k = 0; k < 3; ++k) {
            const std::uint64_t key = std::uint64_t{triangle.material} << 32 | triangle.uv[k];
            const auto [known, is_new] = scaled.try_emplace(key, static_cast<std::uint32_t>(scene.uvs.size()));
            if (is_new) scene.uvs.push_back(to.scale * scene.uvs[triangle.uv[k]] + to.offset);
            triangle.uv[k] = known->second;
        }
    }
}

void warn(SceneDescription& scene, const std::vector<PartBuilder>& parts) {
    Tally crossed, no_area, no_normal;
    for (const PartBuilder& part : parts) {
        crossed.add(part.crossed);
        no_area.add(part.no_area);
        no_normal.add(part.no_normal);
    }
    std::vector<std::string>& to = scene.warnings;
    crossed.tell(to, scene.source, "face whose outline crosses itself or has no area, cut as a fan");
    no_area.tell(to, scene.source, "triangle without area removed");
    no_normal.tell(to, scene.source, "normals ignored: not given, or of no length, at one of a triangle's corners");
}

}  // namespace

void add_obj_triangles(SceneDescription& scene, ObjMesh mesh, const MaterialTable& materials, MeshGroups* groups,
                       int threads) {
    make_unit(mesh.normals, mesh.lengths, threads);
    scene.positions = std::move(mesh.positions);
    scene.normals = std::move(mesh.normals);
    scene.uvs = std::move(mesh.uvs);
    std::vector<std::size_t> first{0};
    for (const ObjFaces& part : mesh.parts) {
        first.push_back(first.back() + part.triangles());
    }
    scene.triangles.resize(first.back());
    if (groups != nullptr) {
        groups->names = std::move(mesh.groups);
        groups->of_triangle.resize(first.back());
    }
    std::vector<PartBuilder> parts;
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        parts.emplace_back(scene, mesh.parts[i], materials, scene.triangles.data() + first[i],
                           groups != nullptr ? groups->of_triangle.data() + first[i] : nullptr);
    }
    for_chunks(static_cast<std::uint32_t>(parts.size()), 1, threads,
               [&](IndexRange range) { parts[range.begin].build(); });
    close_gaps(scene.triangles, first, parts);
    if (groups != nullptr) {
        close_gaps(groups->of_triangle, first, parts);
    }
    if (std::any_of(materials.uvs.begin(), materials.uvs.end(),
                    [](const UvScale& uvs) { return uvs != UvScale{}; })) {
        scale_uvs(scene, materials.uvs);
    }
    warn(scene, parts);
}

}  // namespace pl
