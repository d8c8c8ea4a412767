#include "cpu/rays/batch_tracer.h"

#include <fmt/format.h>

namespace pl {
namespace {

struct NameOf {
    std::string operator()(const DenseIntersector& dense) const { return fmt::format("dense ({})", dense.isa()); }
    std::string operator()(const WideIntersector& wide) const { return fmt::format("wide ({})", wide.isa()); }
};

}  // namespace

BatchTracer::BatchTracer(const SceneView& scene) : intersector_(choose(scene)) {
    if (!scene.instances.empty()) instances_.emplace(scene.instances);
}

BatchTracer::AnyIntersector BatchTracer::choose(const SceneView& scene) {
    if (scene.direct_triangles() <= kMaxDenseTriangles) return DenseIntersector(scene);
    return WideIntersector(scene);
}

std::string BatchTracer::name() const { return std::visit(NameOf{}, intersector_); }

}  // namespace pl
