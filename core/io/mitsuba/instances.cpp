#include "core/io/mitsuba/instances.h"

#include <utility>

#include <fmt/format.h>

#include "core/io/kept_meshes.h"
#include "core/io/mitsuba/shapes.h"
#include "core/scene/instances.h"

namespace pl {
namespace {

[[noreturn]] void fail_full(const MitsubaObject& instance) {
    instance.fail(fmt::format("expected at most {} triangles in the scene, with all copies of shapes, got more",
                              kMostStoredTriangles));
}

/// Takes everything that append_triangles() adds, except warnings.
SceneDescription take_triangles(SceneDescription& scene) {
    SceneDescription taken;
    std::swap(taken.positions, scene.positions);
    std::swap(taken.vertex_colors, scene.vertex_colors);
    std::swap(taken.normals, scene.normals);
    std::swap(taken.uvs, scene.uvs);
    std::swap(taken.triangles, scene.triangles);
    return taken;
}

}  // namespace

MeshOutline outline_of(const SceneDescription& shapes, const std::vector<MaterialDescription>& materials) {
    MeshOutline outline{.triangles = shapes.triangles.size()};
    for (const glm::vec3& position : shapes.positions)
        outline.reach = glm::max(outline.reach, glm::dvec3(glm::abs(position)));
    for (const TriangleDescription& triangle : shapes.triangles)
        outline.emits = outline.emits || materials[triangle.material].emission != glm::vec3(0.0f);
    return outline;
}

void MitsubaInstances::add(const MitsubaObject& instance, const MitsubaGroup& group, SceneDescription& scene) {
    if (shown_.size() == kMostInstances)
        instance.fail(fmt::format("expected at most {} instances, got more", kMostInstances));
    shown_triangles_ += scene.triangles.size() + group.outline.triangles;
    if (shown_triangles_ > kMostShownTriangles) {
        instance.fail(fmt::format("expected at most {} triangles with those of every instance, got {} and more",
                                  kMostShownTriangles, shown_triangles_));
    }
    if (!scene.triangles.empty()) before_.emplace(shown_.size(), take_triangles(scene));
    glm::dmat4 to_world = instance.transform("to_world");
    to_world[3] -= glm::dvec4(scene.origin, 0.0);
    kept_.count(group.number, group.outline, to_world);
    shown_.push_back({instance, &group, to_world});
}

void MitsubaInstances::move_to(SceneDescription& scene) {
    if (shown_.empty()) return;
    if (shown_triangles_ > kMostStoredTriangles) require_room();
    SceneDescription last = take_triangles(scene);
    for (std::size_t i = 0; i < shown_.size(); ++i) {
        if (const auto shapes = before_.find(i); shapes != before_.end()) {
            append_triangles(std::move(shapes->second), scene);
            before_.erase(shapes);
        }
        place(shown_[i], scene);
    }
    append_triangles(std::move(last), scene);
    kept_.move_to(scene);
}

/// Refuses too many copies before they take memory.
void MitsubaInstances::require_room() const {
    std::uint64_t triangles = 0;
    for (const Shown& shown : shown_) {
        const MitsubaGroup& group = *shown.group;
        if (!kept_.is_instance(group.number, group.outline, shown.to_world)) triangles += group.outline.triangles;
        if (triangles > kMostStoredTriangles) fail_full(shown.instance);
    }
}

void MitsubaInstances::place(const Shown& shown, SceneDescription& scene) {
    const MitsubaGroup& group = *shown.group;
    const auto add = [&](const glm::dmat4& to_world, SceneDescription& to) {
        const SceneDescription& kept = kept_.stored();
        if (scene.triangles.size() + kept.triangles.size() + group.shapes.triangles.size() > kMostStoredTriangles ||
            scene.positions.size() + kept.positions.size() + group.shapes.positions.size() > kMostStoredVertices)
            fail_full(shown.instance);
        append_triangles(copy_of_group(shown.instance, group.shapes, to_world), to);
    };
    if (kept_.is_instance(group.number, group.outline, shown.to_world))
        kept_.show(group.number, group.name, shown.to_world, add);
    else
        add(shown.to_world, scene);
}

}  // namespace pl
