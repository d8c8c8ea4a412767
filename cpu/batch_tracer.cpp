#include "cpu/batch_tracer.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "cpu/cpu_backend.h"

namespace pl {
namespace {

struct NameOf {
    std::string operator()(const BvhBatch&) const { return "bvh"; }
    std::string operator()(const DenseIntersector& dense) const { return fmt::format("dense ({})", dense.isa()); }
    std::string operator()(const WideIntersector& wide) const { return fmt::format("wide ({})", wide.isa()); }
#if PL_EMBREE_MAJOR > 0
    std::string operator()(const EmbreeIntersector&) const { return "embree " + EmbreeIntersector::version(); }
#endif
};

IntersectorChoice best_for(const SceneView& scene) {
    return scene.direct_triangles() <= kMaxDenseTriangles ? IntersectorChoice::Dense : IntersectorChoice::Wide;
}

}  // namespace

BatchTracer::BatchTracer(const SceneView& scene, IntersectorChoice choice, int threads)
    : intersector_(choose(scene, choice == IntersectorChoice::Auto ? best_for(scene) : choice, threads)) {
    if (!scene.instances.empty()) instances_.emplace(scene.instances);
}

BatchTracer::AnyIntersector BatchTracer::choose(const SceneView& scene, IntersectorChoice choice,
                                                [[maybe_unused]] int threads) {
    if (choice == IntersectorChoice::Dense) return DenseIntersector(scene);
    if (choice == IntersectorChoice::Wide) return WideIntersector(scene);
    if (choice == IntersectorChoice::Embree) {
#if PL_EMBREE_MAJOR > 0
        return EmbreeIntersector(scene, threads);
#else
        throw Error(ErrorKind::Unavailable, "this build has no Embree");
#endif
    }
    return BvhBatch(scene);
}

std::string BatchTracer::name() const { return std::visit(NameOf{}, intersector_); }

}  // namespace pl
