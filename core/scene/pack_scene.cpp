#include "core/scene/pack_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/kernel/shading/fresnel.h"
#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"
#include "core/scene/pack_steps.h"
#include "core/scene/surface_info.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

/// Albedo of the guided lobes of a surface; 0 if none is guided. Of anisotropic facets the smaller width counts: a streak narrower than
/// the cells of a table is sampled better by its facets.
Vec3f guided_albedo(const MaterialDescription& m) {
    const float across = m.is_anisotropic() ? m.roughness * std::sqrt(std::sqrt(1.0f - m.anisotropy)) : m.roughness;
    const SurfaceInfo& info = surface_info(m.kind);
    return across >= info.least_guided_roughness ? Vec3f{m.*info.color} : Vec3f{0.0f};
}

/// Nothing unless a vertex in use has a color.
void pack_vertex_colors(const SceneDescription& scene, HostScene& packed) {
    const auto has_color = [&](const TriangleDescription& t) {
        for (int k = 0; k < 3; ++k)
            if (scene.vertex_colors[t.vertex[k]] != glm::vec3(1.0f)) return true;
        return false;
    };
    if (!scene.vertex_colors.empty() && std::ranges::any_of(scene.triangles, has_color))
        packed.vertex_colors = scene.vertex_colors;
}

void pack_materials(const SceneDescription& scene, HostScene& packed) {
    packed.materials.reserve(scene.materials.size());
    for (const MaterialDescription& m : scene.materials)
        packed.materials.push_back({guided_albedo(m), m.emission, m.two_sided_emission ? 1u : 0u});
}

/// Appends tables of directional albedos to a scene, each once.
class AlbedoTables {
public:
    explicit AlbedoTables(std::vector<float>& values) : values_(values) {}

    std::uint32_t first_for(const SurfaceInfo& info, float ior) {
        const auto [place, is_new] =
            first_.try_emplace({info.choice.value, ior}, static_cast<std::uint32_t>(values_.size()));
        if (is_new) {
            const std::vector<float> tables = info.tables(ior);
            values_.insert(values_.end(), tables.begin(), tables.end());
        }
        return place->second;
    }

private:
    std::vector<float>& values_;
    std::map<std::pair<SurfaceKind, float>, std::uint32_t> first_;
};

/// A dielectric that hardly refracts counts as smooth, and so do surfaces without a roughness.
float usable_roughness(const MaterialDescription& m) {
    constexpr float kLeastContrast = 1e-3f;
    if (!surface_info(m.kind).has(material_parameter::kRoughness)) return 0.0f;
    const bool refracts = !has_inside(m.kind) || std::fabs(m.ior - 1.0f) > kLeastContrast;
    return refracts ? m.roughness : 0.0f;
}

void pack_lobes(const SceneDescription& scene, HostScene& packed) {
    bool any = false;
    for (const MaterialDescription& m : scene.materials) any = any || m.kind != SurfaceKind::Diffuse;
    if (!any) return;
    AlbedoTables tables(packed.directional_albedo);
    packed.lobes.reserve(scene.materials.size());
    for (const MaterialDescription& m : scene.materials) {
        const SurfaceInfo& info = surface_info(m.kind);
        SurfaceLobes lobes{.kind = m.kind,
                           .roughness = usable_roughness(m),
                           .ior = m.ior,
                           .specular = m.specular,
                           .transmission = m.transmission};
        if (info.has(material_parameter::kEdgeTint))
            lobes.transmission = Vec3f{1.0f} - edge_loss_of(m.specular, m.edge_tint);
        if (info.tables != nullptr && (info.has_smooth_tables || lobes.roughness > 0.0f))
            lobes.table = tables.first_for(info, info.has(material_parameter::kIor) ? m.ior : 1.0f);
        packed.lobes.push_back(lobes);
    }
}

void pack_absorption(const SceneDescription& scene, HostScene& packed) {
    if (std::ranges::none_of(scene.materials, &MaterialDescription::absorbs)) return;
    packed.absorption.reserve(scene.materials.size());
    for (const MaterialDescription& m : scene.materials)
        packed.absorption.push_back(m.absorbs() ? Vec3f{m.absorption} : Vec3f{0.0f});
}

/// Collects the emissive triangles. Sums are in double and rounded once.
void pack_lights(HostScene& packed) {
    std::vector<double> running;
    double total = 0.0;
    for (std::uint32_t id = 0; id < packed.planes.size(); ++id) {
        const Triangle& t = packed.triangles[id];
        const Material& material = packed.materials[t.material];
        if (!material.emits()) continue;
        const double area = 0.5 * glm::length(TriangleCorners(view_of(std::as_const(packed.positions)), t).cross());
        const double power = area * static_cast<double>(luminance(material.emission));
        if (!(power > 0.0)) continue;
        total += power;
        running.push_back(total);
        packed.lights.push_back({id, 1.0f});
    }
    // The last one stays 1, so that every number in [0,1) falls into an interval.
    for (std::size_t i = 0; i + 1 < running.size(); ++i)
        packed.lights[i].cumulative_probability = static_cast<float>(running[i] / total);
    packed.light_power = static_cast<float>(total);
}

/// Packs everything that depends on materials and lights. Expects packed triangles.
void pack_looks(const SceneDescription& scene, HostScene& packed) {
    pack_materials(scene, packed);
    pack_lobes(scene, packed);
    pack_absorption(scene, packed);
    pack_vertex_colors(scene, packed);
    pack_textures(scene, packed);  // replaces textured emission by its mean
    pack_lights(packed);
    packed.environment = scene.environment;
    pack_delta_lights(scene, pack_far_lights(scene, packed), packed);
    pack_light_tree(packed);
}

/// Calls add(i, bounds) for all triangles of a range.
template <class Add>
Bounds bounds_of_triangles(IndexRange triangles, Add&& add) {
    const auto add_all = [&](Bounds& bounds, IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) add(triangles.begin + i, bounds);
    };
    Bounds bounds;
    const std::uint32_t count = triangles.end - triangles.begin;
    for (const Bounds& chunk : sums_of_chunks(count, kElementChunk, usable_threads(), Bounds{}, add_all)) {
        bounds.add(chunk.low);
        bounds.add(chunk.high);
    }
    return bounds;
}
/// The coordinate axis with the largest angle to a direction.
Vec3d farthest_axis(Vec3d direction) {
    const Vec3d a = glm::abs(direction);
    if (a.y <= a.x && a.y <= a.z) return {0.0, 1.0, 0.0};
    return a.x <= a.z ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 0.0, 1.0};
}

/// Normalizes without overflow or underflow of squares, by first scaling to the largest component; 0 stays 0.
Vec3d safe_unit(Vec3d v) {
    const double scale = glm::max(glm::abs(v.x), glm::max(glm::abs(v.y), glm::abs(v.z)));
    return scale > 0.0 ? glm::normalize(v / scale) : Vec3d{0.0};
}

/// Bytes of the packed scene, and of what its construction takes at the same time, by measured peaks.
std::uint64_t bytes_to_pack(const SceneDescription& scene) {
    constexpr std::uint64_t kPerTriangle = 220;  // with its share of the hierarchies, the back end's included
    constexpr std::uint64_t kPerInstance = 400;
    constexpr std::uint64_t kPerTexel = 2 * sizeof(Texel);  // twice while the array grows
    constexpr std::uint64_t kPerMapTexel = 32;
    std::uint64_t texels = 0;
    for (const TextureDescription& texture : scene.textures) texels += texture.texels.size();
    return kPerTriangle * scene.triangles.size() + kPerInstance * scene.instances.size() + kPerTexel * texels +
           kPerMapTexel * scene.environment_map.texels.size() +
           sizeof(Vec3f) * (scene.positions.size() + scene.normals.size() + scene.uvs.size());
}

}  // namespace

Bounds bounds_of(const SceneDescription& scene) {
    Bounds bounds = bounds_of_triangles(IndexRange{0, direct_triangles(scene)}, [&](std::uint32_t i, Bounds& box) {
        for (int corner = 0; corner < 3; ++corner) box.add(scene.positions[scene.triangles[i].vertex[corner]]);
    });
    const std::vector<Bounds> boxes = mesh_boxes(scene);
    for (const InstanceDescription& instance : scene.instances)
        for (const glm::dvec3& corner : box_corners(boxes[instance.mesh], instance.to_world))
            bounds.add(Vec3f{corner});
    return bounds;
}

Bounds bounds_of(const HostScene& scene) {
    const auto direct = static_cast<std::uint32_t>(scene.planes.size());
    Bounds bounds = bounds_of_triangles(IndexRange{0, direct}, [&](std::uint32_t i, Bounds& box) {
        const Triangle& t = scene.triangles[i];
        for (const std::uint32_t corner : {t.v0, t.v1, t.v2}) box.add(scene.positions[corner]);
    });
    if (scene.instance_nodes.empty()) return bounds;
    bounds.add(scene.instance_nodes.front().low);
    bounds.add(scene.instance_nodes.front().high);
    return bounds;
}

HostScene pack_scene(const SceneDescription& scene) {
    require_memory(scene.source.empty() ? "the scene" : scene.source.string(), 0, ErrorKind::Input,
                   bytes_to_pack(scene));
    HostScene packed;
    pack_geometry(scene, packed);
    pack_instances(scene, packed);
    pack_looks(scene, packed);
    return packed;
}

HostScene repack_materials(const SceneDescription& scene, const HostScene& packed) {
    HostScene repacked;
    repacked.positions = packed.positions;
    repacked.triangles = packed.triangles;
    repacked.planes = packed.planes;
    repacked.normals = packed.normals;
    repacked.triangle_normals = packed.triangle_normals;
    repacked.bvh_nodes = packed.bvh_nodes;
    repacked.bvh_leaves = packed.bvh_leaves;
    repacked.bvh_triangles = packed.bvh_triangles;
    repacked.instances = packed.instances;
    repacked.instance_primitives = packed.instance_primitives;
    repacked.instance_nodes = packed.instance_nodes;
    repacked.instance_order = packed.instance_order;
    repacked.mesh_nodes = packed.mesh_nodes;
    repacked.mesh_triangles = packed.mesh_triangles;
    repacked.longest_edge = packed.longest_edge;
    pack_looks(scene, repacked);
    return repacked;
}

// Equal triangles have equal hierarchies.
bool same_triangles(const HostScene& a, const HostScene& b) {
    const auto same_corners = [](const Triangle& s, const Triangle& t) {
        return s.v0 == t.v0 && s.v1 == t.v1 && s.v2 == t.v2;
    };
    const auto same_place = [](const Instance& s, const Instance& t) {
        return s.first_primitive == t.first_primitive && s.first_triangle == t.first_triangle &&
               std::ranges::equal(s.to_world.rows, t.to_world.rows);
    };
    return a.positions == b.positions && std::ranges::equal(a.triangles, b.triangles, same_corners) &&
           std::ranges::equal(a.instances, b.instances, same_place);
}

Camera make_camera(const CameraDescription& camera, int width, int height) {
    /// Below this sine the rounding errors of the input decide the right vector.
    constexpr double kMinSine = 1e-6;
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    Vec3d forward = safe_unit(Vec3d{camera.target} - Vec3d{camera.eye});
    if (forward == Vec3d{0.0}) forward = {0.0, 0.0, -1.0};
    Vec3d right = glm::cross(forward, safe_unit(Vec3d{camera.up}));
    if (!(glm::length(right) > kMinSine)) right = glm::cross(forward, farthest_axis(forward));
    right = glm::normalize(right);
    const Vec3d up = glm::cross(right, forward);
    if (camera.is_mirrored) right = -right;
    const double half_height = std::tan(0.5 * static_cast<double>(camera.fov_deg) * kDegree);
    const double half_width = half_height * static_cast<double>(width) / static_cast<double>(height);
    const Vec3d shift =
        2.0 * half_height * (static_cast<double>(camera.shift.x) * right + static_cast<double>(camera.shift.y) * up);
    return {.eye = camera.eye,
            .axis = Vec3f{forward},
            .center = Vec3f{forward + shift},
            .right = Vec3f{half_width * right},
            .up = Vec3f{half_height * up},
            .aperture_radius = camera.aperture_radius,
            .focus_distance = camera.focus_distance};
}

}  // namespace pl
