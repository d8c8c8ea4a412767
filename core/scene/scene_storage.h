// Owner of a scene's arrays, on host and device: SceneStorage<HostArray>, SceneStorage<DeviceArray>.
#pragma once

#include "core/base/host_array.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

struct SceneScalars {
    double longest_edge = 0.0;  ///< of all triangles, if there are instances
    float light_power = 0.0f;
    Vec3f environment{0.0f};
    FarLights far_lights;  ///< without its arrays
    float far_probability = 0.0f;
    float delta_probability = 0.0f;
};

template <template <class> class Array>
struct SceneStorage : SceneScalars {
    Array<Vec3f> positions;
    Array<Triangle> triangles;
    Array<TrianglePlane> planes;
    Array<Vec3f> normals;
    Array<TriangleNormals> triangle_normals;
    Array<Vec3f> vertex_colors;
    Array<Material> materials;
    Array<SurfaceLobes> lobes;
    Array<float> directional_albedo;
    Array<MaterialAnisotropy> anisotropies;
    Array<Vec3f> absorption;
    Array<Vec2f> uvs;
    Array<TriangleUvs> triangle_uvs;
    Array<Image> images;
    Array<Texel> texels;
    Array<MaterialImages> material_images;
    Array<NormalMap> normal_maps;
    Array<MaterialOpacity> opacities;
    Array<MaterialBlend> blends;
    Array<Light> lights;
    Array<LightNode> light_nodes;
    Array<LightPlace> light_places;
    Array<std::uint32_t> light_clusters;
    Array<DeltaLight> delta_lights;
    Array<MapTexel> map_texels;
    Array<float> map_row_cdf;
    Array<std::int32_t> map_row_index;
    Array<float> map_column_cdf;
    Array<std::int32_t> map_column_index;
    Array<BvhNode> bvh_nodes;
    Array<SmallLeaf> bvh_leaves;
    Array<BvhTriangle> bvh_triangles;
    Array<Instance> instances;
    Array<std::uint32_t> instance_primitives;
    Array<BvhNode> instance_nodes;
    Array<std::uint32_t> instance_order;
    Array<BvhNode> mesh_nodes;
    Array<BvhTriangle> mesh_triangles;

    SceneView view() const {
        FarLights far = far_lights;
        far.map.texels = view_of(map_texels);
        far.map.rows.values = view_of(map_row_cdf);
        far.map.rows.index = view_of(map_row_index);
        far.map.columns.values = view_of(map_column_cdf);
        far.map.columns.index = view_of(map_column_index);
        return {
            .positions = view_of(positions),
            .triangles = view_of(triangles),
            .planes = view_of(planes),
            .normals = view_of(normals),
            .triangle_normals = view_of(triangle_normals),
            .vertex_colors = view_of(vertex_colors),
            .materials = view_of(materials),
            .lobes = view_of(lobes),
            .directional_albedo = view_of(directional_albedo),
            .anisotropies = view_of(anisotropies),
            .absorption = view_of(absorption),
            .textures = {.uvs = view_of(uvs),
                         .triangle_uvs = view_of(triangle_uvs),
                         .images = view_of(images),
                         .texels = view_of(texels),
                         .of_material = view_of(material_images),
                         .normal_maps = view_of(normal_maps)},
            .opacities = view_of(opacities),
            .blends = view_of(blends),
            .lights = view_of(lights),
            .light_tree = {.nodes = view_of(light_nodes),
                           .of_light = view_of(light_places),
                           .clusters = view_of(light_clusters)},
            .bvh = {.nodes = view_of(bvh_nodes), .leaves = view_of(bvh_leaves), .triangles = view_of(bvh_triangles)},
            .instances = {.list = view_of(instances),
                          .first_primitives = view_of(instance_primitives),
                          .nodes = view_of(instance_nodes),
                          .order = view_of(instance_order),
                          .mesh_nodes = view_of(mesh_nodes),
                          .mesh_triangles = view_of(mesh_triangles),
                          .longest_edge = longest_edge},
            .light_power = light_power,
            .environment = environment,
            .far_lights = far,
            .far_probability = far_probability,
            .delta_lights = view_of(delta_lights),
            .delta_probability = delta_probability};
    }
};

using HostScene = SceneStorage<HostArray>;

/// Calls fn(from_array, to_array) for every array and copies the scalars: the single list of members for uploads.
template <template <class> class From, template <class> class To, class Fn>
void zip(const SceneStorage<From>& from, SceneStorage<To>& to, Fn&& fn) {
    fn(from.positions, to.positions);
    fn(from.triangles, to.triangles);
    fn(from.planes, to.planes);
    fn(from.normals, to.normals);
    fn(from.triangle_normals, to.triangle_normals);
    fn(from.vertex_colors, to.vertex_colors);
    fn(from.materials, to.materials);
    fn(from.lobes, to.lobes);
    fn(from.directional_albedo, to.directional_albedo);
    fn(from.anisotropies, to.anisotropies);
    fn(from.absorption, to.absorption);
    fn(from.uvs, to.uvs);
    fn(from.triangle_uvs, to.triangle_uvs);
    fn(from.images, to.images);
    fn(from.texels, to.texels);
    fn(from.material_images, to.material_images);
    fn(from.normal_maps, to.normal_maps);
    fn(from.opacities, to.opacities);
    fn(from.blends, to.blends);
    fn(from.lights, to.lights);
    fn(from.light_nodes, to.light_nodes);
    fn(from.light_places, to.light_places);
    fn(from.light_clusters, to.light_clusters);
    fn(from.delta_lights, to.delta_lights);
    fn(from.map_texels, to.map_texels);
    fn(from.map_row_cdf, to.map_row_cdf);
    fn(from.map_row_index, to.map_row_index);
    fn(from.map_column_cdf, to.map_column_cdf);
    fn(from.map_column_index, to.map_column_index);
    fn(from.bvh_nodes, to.bvh_nodes);
    fn(from.bvh_leaves, to.bvh_leaves);
    fn(from.bvh_triangles, to.bvh_triangles);
    fn(from.instances, to.instances);
    fn(from.instance_primitives, to.instance_primitives);
    fn(from.instance_nodes, to.instance_nodes);
    fn(from.instance_order, to.instance_order);
    fn(from.mesh_nodes, to.mesh_nodes);
    fn(from.mesh_triangles, to.mesh_triangles);
    static_cast<SceneScalars&>(to) = from;
}

/// Total size of all arrays.
inline std::uint64_t bytes_of(const HostScene& scene) {
    std::uint64_t bytes = 0;
    HostScene nowhere;
    zip(scene, nowhere, [&](const auto& array, auto&) { bytes += array.size() * sizeof(array[0]); });
    return bytes;
}

}  // namespace pl
