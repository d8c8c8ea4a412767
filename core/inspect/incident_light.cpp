#include "core/inspect/incident_light.h"

#include <cmath>
#include <numeric>

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"

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

namespace {

/// Emission at the end of a ray that light sampling at its origin could have found, and its density there.
struct FoundEmission {
    Vec3f radiance{0.0f};
    float light_pdf_sa = 0.0f;
};

FoundEmission emission_along(const SceneView& scene, const Ray& ray) {
    constexpr FeatureSet kAll = kEveryFeature;
    const Hit hit = closest_solid_hit<kAll>(scene, BvhIntersector{scene}, ray);
    if (!hit.found()) {
        if (scene.far_lights.empty()) return {};
        return {far_radiance(scene.far_lights, ray.direction), far_light_pdf_sa(scene, ray.direction)};
    }
    const SurfacePoint surface = make_surface_point<kAll>(scene, hit, -ray.direction);
    const Vec3f emitted = emitted_at<kAll>(scene, surface, hit_weights(hit));
    if (is_black(emitted)) return {};
    return {emitted, light_pdf_sa<kAll>(scene, ray.origin, surface, ray.direction)};
}

/// The radiance along a ray by a path of the baseline method.
Vec3f path_radiance(const SceneView& scene, const PathSettings& path, const Ray& ray, std::uint32_t number,
                    std::uint32_t sample) {
    PathState<kEveryFeature, DefaultMethod> state;
    state.ray = ray;
    state.pixel = number;
    state.sample = sample;
    PathCounters counters;
    const DefaultMethod method;
    trace_path<kEveryFeature>(PathContext<DefaultMethod>{scene, method, path}, BvhIntersector{scene}, state,
                              counters);
    return state.radiance;
}

float fraction_of(double x) { return static_cast<float>(x - std::floor(x)); }

}  // namespace

std::uint64_t IncidentLight::paths_per_cell() const {
    return std::accumulate(paths.begin(), paths.end(), std::uint64_t{0});
}

LightGatherer::LightGatherer(std::shared_ptr<const HostScene> scene, const LightReceiver& receiver, PathSettings path)
    : scene_(std::move(scene)), bsdf_(scene_->view(), receiver), path_(path) {
    path_.stream = Stream::Inspection;
    path_.next_event = 1;
    light_.side = receiver.side;
    light_.radiance.assign(light_.cells() * kLightGroups, 0.0);
    light_.reflected.assign(light_.cells() * kLightGroups, 0.0);
    light_.guided_share = bsdf_.guided_share();
    light_.bsdf_share = cell_shares(receiver.side, bsdf_.fine_pdf());
}

/// A sequence of its own for each cell and group, spread evenly and shifted at random: each of its points is uniform.
/// [Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences", R2]
Vec2f LightGatherer::point_in_cell(std::uint32_t cell, std::uint32_t round) const {
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    const std::uint32_t group = round % kLightGroups;
    const auto index = static_cast<double>(round / kLightGroups);
    const Vec4f shift = path_rng(path_, cell, group).draw(0, Purpose::Probe);
    return {fraction_of(static_cast<double>(shift.x) + index * kStepX),
            fraction_of(static_cast<double>(shift.y) + index * kStepY)};
}

void LightGatherer::trace(std::uint32_t cell, std::uint32_t round) {
    const SceneView scene = scene_->view();
    const LightReceiver& receiver = bsdf_.receiver();
    const auto number =
        static_cast<std::uint32_t>(receiver.volume) * static_cast<std::uint32_t>(light_.cells()) + cell;
    const DirectionCells cells{.side = receiver.side};
    const Vec2f square = cells.point_in_cell(static_cast<int>(cell), point_in_cell(number, round));
    const Vec3f wi = make_frame(receiver.normal).to_world(square_to_cosine_hemisphere(square));
    const Ray ray = spawn_ray(receiver.site, wi);
    const Vec3f radiance = path_radiance(scene, path_, ray, number, round);
    if (!is_valid_radiance(radiance)) {
        ++light_.invalid_paths;
        return;
    }
    const FoundEmission found = emission_along(scene, ray);
    const Vec3f rest = radiance - found.radiance;
    const std::uint32_t group = round % kLightGroups;
    const std::size_t index = group * light_.cells() + cell;
    light_.radiance[index] += static_cast<double>(rms(rest));
    light_.reflected[index] += static_cast<double>(bsdf_.reflected(wi, rest));
    if (is_black(found.radiance)) return;
    const float cosine_pdf = kInvPi * glm::dot(wi, receiver.normal);
    light_.emission.push_back({.cell = cell,
                               .group = group,
                               .fine_cell = fine_cell_of(receiver.side, square),
                               .light_pdf = found.light_pdf_sa / cosine_pdf,
                               .bsdf_pdf = bsdf_.pdf(wi),
                               .radiance = rms(found.radiance),
                               .reflected = bsdf_.reflected(wi, found.radiance)});
}

bool LightGatherer::advance(const StopFlag* stop) {
    const auto cells = static_cast<std::uint32_t>(light_.cells());
    for (; next_cell_ < cells; ++next_cell_) {
        if (stop != nullptr && *stop) return false;
        trace(next_cell_, round_);
    }
    next_cell_ = 0;
    ++light_.paths[round_++ % kLightGroups];
    return true;
}

}  // namespace pl
