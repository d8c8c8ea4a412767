#include "ui/model/outside_view.h"

#include "core/kernel/base/frame.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/scene/surface_point.h"

namespace pl::ui {
namespace {

constexpr int kWalksAcross = 8;         ///< of the picture, in both directions
constexpr std::uint32_t kVertices = 4;  ///< of a walk: from an open box half of the directions at each vertex escape
constexpr int kFewestInside = 3;        ///< of 64 walks

/// Whether a walk meets an emitter, or is still in the scene at its end.
bool stays_inside(const SceneView& scene, Ray ray, const Rng& rng) {
    for (std::uint32_t vertex = 0; vertex < kVertices; ++vertex) {
        const Hit hit = BvhIntersector{scene}.closest_hit(ray);
        if (!hit.found()) return false;
        const SurfacePoint surface = make_surface_point<kPlaceFeatures>(scene, hit, -ray.direction);
        if (scene.materials[surface.material].emits()) return true;
        const Vec4f u = rng.draw(vertex, Purpose::Scatter);
        const Frame frame = make_frame(surface.geometric_normal);
        const Vec3f direction = square_to_cosine_hemisphere({u.x, u.y});
        ray = {.origin = surface.position + surface.position_error * surface.geometric_normal,
               .direction = direction.x * frame.x + direction.y * frame.y + direction.z * frame.z};
    }
    return true;
}

}  // namespace

bool looks_outside(const HostScene& host, const CameraDescription& description, int width, int height) {
    const SceneView scene = host.view();
    if (!is_black(scene.environment) || !scene.far_lights.empty() || !scene.delta_lights.empty()) return false;
    const Camera camera = make_camera(description, width, height);
    const Vec2f size{static_cast<float>(width), static_cast<float>(height)};
    int inside = 0;
    for (int walk = 0; walk < kWalksAcross * kWalksAcross; ++walk) {
        const Vec2f at{static_cast<float>(walk % kWalksAcross), static_cast<float>(walk / kWalksAcross)};
        const Ray ray = generate_ray(camera, (at + 0.5f) / static_cast<float>(kWalksAcross) * size, size);
        const Rng rng{.stream = Stream::Inspection, .pixel = static_cast<std::uint32_t>(walk)};
        inside += stays_inside(scene, ray, rng) ? 1 : 0;
    }
    return inside < kFewestInside;
}

void OutsideView::update(const std::shared_ptr<const PublishedFrame>& frame) {
    if (!frame || (frame->scene == scene_ && frame->generation == generation_)) return;
    scene_ = frame->scene;
    generation_ = frame->generation;
    is_outside_ = looks_outside(*scene_, frame->snapshot.camera, frame->snapshot.width, frame->snapshot.height);
}

}  // namespace pl::ui
