#include "core/inspect/site_bsdf.h"

namespace pl {
namespace {

/// Barycentric weights of a point of a triangle.
Vec3f weights_of(const SceneView& scene, const SurfacePoint& point) {
    const CornersOf<One> corners = flat_primitive<kEveryFeature>(scene, point.primitive).corners;
    const Vec3d p0{pack(corners.p0)};
    const Vec3d edge1 = Vec3d{pack(corners.p1)} - p0;
    const Vec3d edge2 = Vec3d{pack(corners.p2)} - p0;
    const Vec3d offset = Vec3d{point.position} - p0;
    const Vec3d normal = glm::cross(edge1, edge2);
    const double area2 = glm::dot(normal, normal);
    const double b1 = glm::dot(glm::cross(offset, edge2), normal) / area2;
    const double b2 = glm::dot(glm::cross(edge1, offset), normal) / area2;
    return {static_cast<float>(1.0 - b1 - b2), static_cast<float>(b1), static_cast<float>(b2)};
}

}  // namespace

LightReceiver LightReceiver::of(const VolumeInspection& volume, Vec3f eye) {
    const Vec3f towards_eye = glm::normalize(eye - volume.position);
    const bool is_in_front = glm::dot(towards_eye, volume.normal) > 0.0f;
    return {.volume = volume.volume,
            .site = volume.site,
            .normal = volume.normal,
            .wo = is_in_front ? towards_eye : volume.normal,
            .side = volume.side};
}

SiteBsdf::SiteBsdf(const SceneView& scene, const LightReceiver& receiver)
    : receiver_(receiver),
      bsdf_(make_bsdf<kEveryFeature>(scene, receiver.site, weights_of(scene, receiver.site), receiver.wo)) {}

float SiteBsdf::reflected(Vec3f wi, Vec3f radiance) const {
    const float cos_i = bsdf_.cosine(receiver_.site, wi);
    if (cos_i == 0.0f) return 0.0f;
    const float cosine_pdf = kInvPi * glm::dot(wi, receiver_.normal);
    return rms(bsdf_.eval(receiver_.site, wi, cos_i) * radiance) / cosine_pdf;
}

float SiteBsdf::pdf(Vec3f wi) const {
    return bsdf_.pdf_sa(receiver_.site, wi) / (kInvPi * glm::dot(wi, receiver_.normal));
}

std::vector<float> SiteBsdf::fine_pdf() const {
    const Frame frame = make_frame(receiver_.normal);
    std::vector<float> density;
    for_each_fine_point(receiver_.side, [&](Vec2f square) {
        density.push_back(pdf(frame.to_world(square_to_cosine_hemisphere(square))));
    });
    return density;
}

}  // namespace pl
