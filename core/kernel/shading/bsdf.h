// The BSDF at a surface point. Kernels are templates over it: LambertBsdf, an albedo alone, serves scenes with
// diffuse surfaces only, LayeredBsdf all others.
#pragma once

#include "core/kernel/base/features.h"
#include "core/kernel/shading/anisotropy.h"
#include "core/kernel/shading/conductor.h"
#include "core/kernel/shading/dielectric.h"
#include "core/kernel/shading/lambert.h"
#include "core/kernel/shading/plastic.h"
#include "core/kernel/shading/textured.h"
#include "core/kernel/shading/velvet.h"

namespace pl {

/// Sample of a delta lobe.
struct DeltaDirection {
    Vec3f wi{0.0f};
    Vec3f weight{0.0f};  ///< f / probability of the choice; black: no contribution
};

struct LambertBsdf {
    Vec3f reflectance{0.0f};

    PL_HD Vec3f albedo() const { return reflectance; }
    PL_HD bool scatters() const { return !is_black(reflectance); }
    static PL_HD constexpr bool is_lambert() { return true; }
    static PL_HD constexpr bool is_specular() { return false; }
    /// |cos theta_i| at the shading normal; 0 for directions that the BSDF is black for.
    PL_HD float cosine(const SurfacePoint& surface, Vec3f wi) const { return reflection_cosine(surface, wi); }
    PL_HD Vec3f eval(const SurfacePoint&, Vec3f, float cos_i) const { return lambert_eval(reflectance, cos_i); }
};

/// The facets of a LayeredBsdf in kernels without anisotropy.
struct IsotropicFacets {
    struct Grain {};
    using Width = IsotropicWidth;

    IsotropicFacets() = default;
    PL_HD explicit IsotropicFacets(const Grain&) {}

    static PL_HD Ggx ggx(float roughness) { return {{square(roughness)}}; }
    static PL_HD float table_roughness(float roughness) { return roughness; }
    static PL_HD Frame frame(const Grain&, Vec3f normal) { return make_frame(normal); }
};

template <FeatureSet F>
using FacetsOf = std::conditional_t<F.has(Feature::Anisotropy), AnisotropicFacets, IsotropicFacets>;

/// The BSDF of any SurfaceKind, for surfaces whose effects are in F. A vertex samples the delta lobe with probability
/// delta_probability(), else the others, which eval(), pdf_sa() and sample() describe; their densities and weights
/// exclude that probability. Each switch names every kind, so that a new one does not compile before it has its case.
template <FeatureSet F>
class LayeredBsdf : FacetsOf<F> {
    using Facets = FacetsOf<F>;

public:
    using Grain = typename Facets::Grain;

    LayeredBsdf() = default;

    /// `albedo`, `lobes`: of the material at this point; `tables`: SceneView::directional_albedo.
    PL_HD LayeredBsdf(const SurfacePoint& surface, Vec3f wo, Vec3f albedo, const SurfaceLobes& lobes,
                      Span<const float> tables, const Grain& grain = {})
        : Facets(grain), reflectance_(albedo), lobes_(lobes), tables_(tables.data + lobes.table), albedo_(albedo) {
        if (!is_lambert()) face(surface, wo, grain);
    }

    PL_HD bool is_lambert() const { return lobes_.kind == SurfaceKind::Diffuse; }
    /// Not guided: the vertex learns nothing and passes the incident radiance on to the previous vertex.
    PL_HD bool is_specular() const { return is_black(reflectance_) && scatters(); }
    /// Has an inside, which paths enter and leave.
    PL_HD bool refracts() const { return lobes_.kind == SurfaceKind::Dielectric; }
    PL_HD bool scatters() const { return lobes_.kind == SurfaceKind::Dielectric || !is_black(albedo_); }
    /// Directional albedo: the reflected and transmitted share of uniform incident radiance, towards wo.
    PL_HD Vec3f albedo() const { return albedo_; }

    PL_HD float delta_probability() const {
        if (!smooth()) return 0.0f;
        switch (lobes_.kind) {
        case SurfaceKind::Plastic: return plastic().coat_probability();
        case SurfaceKind::Diffuse:
        case SurfaceKind::Conductor:
        case SurfaceKind::Dielectric:
        case SurfaceKind::Pane:
        case SurfaceKind::Velvet: break;
        }
        return 1.0f;
    }
    /// u in [0, 1).
    PL_HD DeltaDirection sample_delta(const SurfacePoint& surface, float u) const {
        const Vec3f up{0.0f, 0.0f, 1.0f};
        DeltaDirection delta{reflect_at(wo_, up), Vec3f{0.0f}};
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse:
        case SurfaceKind::Velvet: break;
        case SurfaceKind::Conductor:
            delta.weight = fresnel_conductor(wo_.z, lobes_.specular, lobes_.edge_loss());
            break;
        case SurfaceKind::Plastic: delta.weight = lobes_.specular * fresnel_dielectric(wo_.z, eta_); break;
        case SurfaceKind::Dielectric:
            if (u < fresnel_dielectric(min_of(wo_.z, 1.0f), eta_))
                delta.weight = lobes_.specular;
            else
                delta = {refract_at(wo_, up, eta_), lobes_.transmission * (1.0f / (eta_ * eta_))};
            break;
        case SurfaceKind::Pane:
            if constexpr (F.has(Feature::ThinPanes)) {
                if (u < fresnel_pane(min_of(wo_.z, 1.0f), lobes_.ior))
                    delta.weight = lobes_.specular;
                else
                    delta = {-wo_, lobes_.transmission};
            }
            break;
        }
        return to_sides(surface, delta);
    }

    /// |cos theta_i| at the shading normal; 0 for directions that eval() is black for.
    PL_HD float cosine(const SurfacePoint& surface, Vec3f wi) const {
        if (is_lambert()) return reflection_cosine(surface, wi);
        const float above = glm::dot(wi, surface.geometric_normal);
        const float z = glm::dot(wi, frame_.z);
        if (!(above * z > 0.0f)) return 0.0f;
        if (z < 0.0f && !refracts()) return 0.0f;
        return is_wide() ? std::fabs(z) : 0.0f;
    }
    /// BSDF times |cos theta_i|, 1/sr, without delta lobes, for a direction whose cosine() is not 0.
    PL_HD Vec3f eval(const SurfacePoint&, Vec3f wi, float cos_i) const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse: return lambert_eval(reflectance_, cos_i);
        case SurfaceKind::Conductor: return conductor().eval(frame_.to_local(wi));
        case SurfaceKind::Dielectric: return dielectric().eval(frame_.to_local(wi));
        case SurfaceKind::Plastic: return plastic().eval(frame_.to_local(wi));
        case SurfaceKind::Velvet:
            if constexpr (F.has(Feature::Velvet)) return velvet().eval(frame_.to_local(wi));
            break;
        case SurfaceKind::Pane: break;
        }
        return Vec3f{0.0f};
    }
    PL_HD float pdf_sa(const SurfacePoint& surface, Vec3f wi) const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse: return lambert_pdf_sa(surface, wi);
        case SurfaceKind::Conductor: return conductor().pdf_sa(frame_.to_local(wi));
        case SurfaceKind::Dielectric: return dielectric().pdf_sa(frame_.to_local(wi));
        case SurfaceKind::Plastic: return plastic().pdf_sa(frame_.to_local(wi));
        case SurfaceKind::Velvet:
            if constexpr (F.has(Feature::Velvet)) return velvet().pdf_sa(frame_.to_local(wi));
            break;
        case SurfaceKind::Pane: break;
        }
        return 0.0f;
    }
    /// A unit direction with density pdf_sa() per steradian, or 0 for a sample of value 0; u in [0,1)^2, `choice` in
    /// [0, 1).
    PL_HOST_APART PL_HD inline Vec3f sample(const SurfacePoint& surface, Vec2f u, float choice) const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse: return lambert_sample(surface, u);
        case SurfaceKind::Conductor: return to_world(conductor().sample(u, choice));
        case SurfaceKind::Dielectric: return to_world(dielectric().sample(u, choice));
        case SurfaceKind::Plastic: return to_world(plastic().sample(u, choice));
        case SurfaceKind::Velvet:
            if constexpr (F.has(Feature::Velvet)) return to_world(velvet().sample(u, choice));
            break;
        case SurfaceKind::Pane: break;
        }
        return Vec3f{0.0f};
    }

private:
    static constexpr float kGrazing = 1e-5f;

    /// Sets what depends on the direction, of a surface that is no Lambert reflector.
    PL_HOST_APART PL_HD inline void face(const SurfacePoint& surface, Vec3f wo, const Grain& grain) {
        // The shading normal may face away from the viewer; the geometric one never does.
        const bool usable = glm::dot(wo, surface.shading_normal) > kGrazing;
        frame_ = Facets::frame(grain, usable ? surface.shading_normal : surface.geometric_normal);
        wo_ = frame_.to_local(wo);
        wo_.z = max_of(wo_.z, kGrazing);
        // A coat is on both sides; the back of a dielectric is its inside.
        const bool is_inside = refracts() && !surface.front;
        eta_ = is_inside ? 1.0f / lobes_.ior : lobes_.ior;
        if (is_inside && !smooth()) tables_ += AlbedoTable::kSize;
        returned_ = returned_by_facets();
        albedo_ = directional_albedo();
    }

    /// Whether a delta lobe is among the lobes.
    PL_HD bool smooth() const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse:
        case SurfaceKind::Velvet: return false;
        case SurfaceKind::Conductor:
        case SurfaceKind::Dielectric:
        case SurfaceKind::Plastic:
        case SurfaceKind::Pane: break;
        }
        return lobes_.roughness == 0.0f;
    }
    /// Whether other lobes are.
    PL_HD bool is_wide() const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse:
        case SurfaceKind::Plastic:
        case SurfaceKind::Velvet: return true;
        case SurfaceKind::Conductor:
        case SurfaceKind::Dielectric:
        case SurfaceKind::Pane: break;
        }
        return lobes_.roughness > 0.0f;
    }
    PL_HD float returned_by_facets() const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse:
        case SurfaceKind::Pane: break;
        case SurfaceKind::Plastic: return plastic().reflected_by_coat(wo_.z);
        case SurfaceKind::Velvet:
            if constexpr (F.has(Feature::Velvet)) return velvet().reflected_by_fibers(wo_.z);
            break;
        case SurfaceKind::Conductor:
        case SurfaceKind::Dielectric:
            if (smooth()) break;
            return AlbedoTable{tables_}.at(Facets::table_roughness(lobes_.roughness), wo_.z);
        }
        return 1.0f;
    }
    PL_HD Vec3f to_world(Vec3f local) const {
        return is_black(local) ? local : glm::normalize(frame_.to_world(local));
    }
    /// To the world; black if the direction lies on the other side of the triangle than of the shading normal's plane.
    PL_HD DeltaDirection to_sides(const SurfacePoint& surface, DeltaDirection delta) const {
        const bool passes = delta.wi.z < 0.0f;
        delta.wi = glm::normalize(frame_.to_world(delta.wi));
        if ((glm::dot(delta.wi, surface.geometric_normal) < 0.0f) != passes) delta.weight = Vec3f{0.0f};
        return delta;
    }
    PL_HD Ggx ggx() const { return IsotropicFacets::ggx(lobes_.roughness); }

    PL_HD RoughConductor<typename Facets::Width> conductor() const {
        const float roughness = lobes_.roughness;
        return {Facets::ggx(roughness),
                lobes_.specular,
                lobes_.edge_loss(),
                {tables_},
                Facets::table_roughness(roughness),
                wo_,
                returned_};
    }
    PL_HD RoughDielectric dielectric() const {
        return {ggx(), eta_, lobes_.specular, lobes_.transmission, wo_, returned_};
    }
    PL_HD Plastic plastic() const {
        return {ggx(), reflectance_, lobes_.specular, eta_, {tables_}, lobes_.roughness, wo_, returned_};
    }
    PL_HD Velvet velvet() const {
        const float roughness = max_of(lobes_.roughness, SheenFibers::kLeastRoughness);
        return {reflectance_, lobes_.specular, roughness, {tables_}, wo_, returned_};
    }
    PL_HD Vec3f directional_albedo() const {
        switch (lobes_.kind) {
        case SurfaceKind::Diffuse: return reflectance_;
        case SurfaceKind::Conductor:
            return smooth() ? fresnel_conductor(wo_.z, lobes_.specular, lobes_.edge_loss()) : conductor().albedo();
        case SurfaceKind::Dielectric:
        case SurfaceKind::Pane: return glm::max(lobes_.specular, lobes_.transmission);
        case SurfaceKind::Plastic: return plastic().albedo();
        case SurfaceKind::Velvet:
            if constexpr (F.has(Feature::Velvet)) return velvet().albedo();
            break;
        }
        return Vec3f{0.0f};
    }

    Vec3f reflectance_{0.0f};
    SurfaceLobes lobes_{};
    const float* tables_ = nullptr;
    Frame frame_{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    Vec3f wo_{0.0f, 0.0f, 1.0f};
    float eta_ = 1.0f;
    float returned_ = 1.0f;  ///< directional albedo of the interface by single scattering, for wo
    Vec3f albedo_{0.0f};
};

template <FeatureSet F>
using Bsdf = std::conditional_t<F.has_any(kLobeFeatures), LayeredBsdf<F.common(kSurfaceFeatures)>, LambertBsdf>;

/// The directions of a material's facets at a surface point, for the facets of F.
template <FeatureSet F>
PL_HD inline auto grain_at([[maybe_unused]] const SceneView& scene, [[maybe_unused]] const SurfacePoint& surface,
                           [[maybe_unused]] std::uint32_t material) {
    typename FacetsOf<F>::Grain grain;
    if constexpr (F.has(Feature::Anisotropy)) {
        if (!scene.anisotropies.empty()) grain = grain_of<F>(scene, surface, material);
    }
    return grain;
}

/// The BSDF of a surface point for wo: of a blend, the BSDF of the chosen material, with the normal of the material
/// that blends. `b`: barycentric weights of the point.
template <FeatureSet F>
PL_HD inline Bsdf<F> make_bsdf(const SceneView& scene, const SurfacePoint& surface, Vec3f b, Vec3f wo) {
    const MaterialPoint shown = shown_material<F>(scene, surface, b, wo);
    const Vec3f albedo = albedo_at<F>(scene, shown);
    if constexpr (F.has_any(kLobeFeatures)) {
        const SurfaceLobes lobes = scene.lobes.empty() ? SurfaceLobes{} : lobes_at<F>(scene, shown);
        const auto grain = grain_at<F>(scene, surface, shown.material);
        if constexpr (F.has(Feature::NormalMaps)) {
            if (has_normal_map(scene.textures, surface.material)) {
                SurfacePoint bent = surface;
                bent.shading_normal = reflecting_normal(surface.shading_normal, surface.geometric_normal, wo);
                return {bent, wo, albedo, lobes, scene.directional_albedo, grain};
            }
        }
        return {surface, wo, albedo, lobes, scene.directional_albedo, grain};
    } else {
        return {albedo};
    }
}

}  // namespace pl
