#include "cpu/batch_tracer.h"

#include <fmt/format.h>

#include "cpu/cpu_backend.h"

namespace pl {
namespace {

struct NameOf {
    std::string operator()(const BvhBatch&) const { return "bvh"; }
    std::string operator()(const DenseIntersector& dense) const { return fmt::format("dense ({})", dense.isa()); }
    std::string operator()(const WideIntersector& wide) const { return fmt::format("wide ({})", wide.isa()); }
};

IntersectorChoice best_for(const SceneView& scene) {
    return scene.direct_triangles() <= kMaxDenseTriangles ? IntersectorChoice::Dense : IntersectorChoice::Wide;
}

}  // namespace

BatchTracer::BatchTracer(const SceneView& scene, IntersectorChoice choice)
    : intersector_(choose(scene, choice == IntersectorChoice::Auto ? best_for(scene) : choice)) {
    if (!scene.instances.empty()) instances_.emplace(scene.instances);
}

BatchTracer::AnyIntersector BatchTracer::choose(const SceneView& scene, IntersectorChoice choice) {
    if (choice == IntersectorChoice::Dense) return DenseIntersector(scene);
    if (choice == IntersectorChoice::Wide) return WideIntersector(scene);
    return BvhBatch(scene);
}

std::string BatchTracer::name() const { return std::visit(NameOf{}, intersector_); }

}  // namespace pl
