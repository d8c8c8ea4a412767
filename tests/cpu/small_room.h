// A small room with a light and a block, a field of a few volumes, and a back end with both.
#pragma once

#include "core/fields/place_volumes.h"
#include "core/fields/table_model.h"
#include "core/fields/volume_grid.h"
#include "core/scene/needed_effects.h"
#include "cpu/cpu_backend.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// 26 triangles, closed.
inline SceneDescription small_room() {
    SceneDescription scene;
    scene.materials = {{.name = "white", .albedo = glm::vec3(0.7f)},
                       {.name = "red", .albedo = glm::vec3(0.6f, 0.1f, 0.1f)},
                       {.name = "lamp", .albedo = glm::vec3(0.2f), .emission = glm::vec3(8.0f, 6.0f, 4.0f)}};
    add_box(scene, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    add_box(scene, {-0.6f, -1.0f, -0.5f}, {0.1f, -0.2f, 0.2f}, false, 1);
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Vec3f corner :
         {Vec3f{-0.3f, 0.99f, -0.3f}, Vec3f{0.3f, 0.99f, -0.3f}, Vec3f{0.3f, 0.99f, 0.3f}, Vec3f{-0.3f, 0.99f, 0.3f}})
        add_vertex(scene, corner);
    add_quad(scene, first, first + 1, first + 2, first + 3, 2);
    scene.camera.eye = {0.0f, 0.1f, 0.95f};
    scene.camera.target = {0.0f, -0.1f, -1.0f};
    scene.camera.fov_deg = 70.0f;
    return scene;
}

/// Not a multiple of any batch or chunk size.
inline constexpr int kWidth = 61;
inline constexpr int kHeight = 43;

inline FieldSettings small_field() {
    FieldSettings settings;
    settings.volumes = 40;
    settings.bins = 16;
    return settings;
}

/// Inputs of a back end: scene, placement, shape of the field, camera.
struct Room {
    std::shared_ptr<const HostScene> scene;
    std::shared_ptr<const HostVolumes> volumes;
    FieldShape shape;
    Camera camera;

    explicit Room(const SceneDescription& description = small_room())
        : scene(std::make_shared<const HostScene>(pack_scene(description))), volumes(with_grid(*scene)),
          shape(make_field_shape(*scene, small_field())), camera(make_camera(description.camera, kWidth, kHeight)) {}

    static std::shared_ptr<const HostVolumes> with_grid(const HostScene& scene) {
        HostVolumes placed = place_volumes(scene, small_field());
        placed.grid = build_volume_grid(scene, placed, 1);
        return std::make_shared<const HostVolumes>(std::move(placed));
    }
    HostTables empty_tables() const { return make_arrays<HostTables>(shape, volumes->normals.size()); }
};

inline std::unique_ptr<RenderBackend> make_backend(const Room& room, const CpuSettings& settings) {
    auto backend = make_cpu_backend(settings);
    backend->upload_scene(room.scene);
    backend->upload_volumes(room.volumes, room.shape);
    return backend;
}

}  // namespace pl::test
