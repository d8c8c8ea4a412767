#include "core/scene/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {
namespace {

/// Facets per table entry: values are then off by 1e-3 or so. A grid of as many is off by ten times that.
constexpr int kSamples = 1024;
/// Rows below this roughness hold what a smooth surface reflects: facets are too small a matter to tell.
constexpr float kSmooth = 1e-3f;

/// Additive recurrence of low discrepancy in the unit square, by the plastic number.   [Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences"]
Vec2f spread_point(int i) {
    const double x = 0.5 + i * 0.7548776662466927;
    const double y = 0.5 + i * 0.5698402909980532;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

/// Mean over the facets that a direction sees, of what those return by `value(ggx, wo, m)`.
template <class Value>
float mean_over_facets(float roughness, float cos_theta, Value value) {
    const Ggx ggx{square(roughness)};
    const Vec3f wo{safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta};
    double sum = 0.0;
    for (int i = 0; i < kSamples; ++i) sum += static_cast<double>(value(ggx, wo, ggx.sample(wo, spread_point(i))));
    return static_cast<float>(sum / kSamples);
}

/// Share of the light mirrored by a facet that leaves the surface.   [Heitz 2018, eq. 19: f cos / pdf = F G2 / G1]
float mirrored(const Ggx& ggx, Vec3f wo, Vec3f m) {
    const Vec3f wi = reflect_at(wo, m);
    return wi.z > 0.0f ? ggx.visible(wo, wi) / ggx.visible(wo) : 0.0f;
}
float refracted(const Ggx& ggx, Vec3f wo, Vec3f m, float eta) {
    const Vec3f wi = refract_at(wo, m, eta);
    return wi.z < 0.0f ? ggx.visible(wo, wi) / ggx.visible(wo) : 0.0f;
}

/// Twice the integral of a row over the cosine times the cosine, as AlbedoTable interpolates it.
float mean_of_row(const float* row) {
    constexpr int kSteps = 32;
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i + 1 < AlbedoTable::kCosines; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double share = (k + 0.5) / kSteps;
            const double root = (i + share) / (AlbedoTable::kCosines - 1);
            const double weight = root * root * root;  // mu dmu with mu = root^2
            sum += weight * (static_cast<double>(row[i]) * (1.0 - share) + static_cast<double>(row[i + 1]) * share);
            weights += weight;
        }
    return static_cast<float>(sum / weights);
}

/// `smooth(cos)` fills the row of roughness 0, `value` as in mean_over_facets() the others.
template <class Smooth, class Value>
std::vector<float> make_table(Smooth smooth, Value value) {
    std::vector<float> table;
    table.reserve(AlbedoTable::kSize);
    for (int r = 0; r < AlbedoTable::kRoughnesses; ++r) {
        const float roughness = static_cast<float>(r) / (AlbedoTable::kRoughnesses - 1);
        for (int c = 0; c < AlbedoTable::kCosines; ++c) {
            // Edge-on itself, hardly a facet is seen: the value a little above stands for it.
            const float cos_theta = max_of(square(static_cast<float>(c) / (AlbedoTable::kCosines - 1)), 1e-4f);
            const float returned =
                roughness < kSmooth ? smooth(cos_theta) : mean_over_facets(roughness, cos_theta, value);
            table.push_back(std::min(returned, 1.0f));
        }
    }
    for (int r = 0; r < AlbedoTable::kRoughnesses; ++r)
        table.push_back(mean_of_row(table.data() + r * AlbedoTable::kCosines));
    return table;
}

float facet_reflectance(Vec3f wo, Vec3f m, float eta) {
    return fresnel_dielectric(clamp_to(glm::dot(wo, m), 0.0f, 1.0f), eta);
}

/// Tables made so far by their eta. One costs some 33 ms, and every edit of any material packs the scene anew.
class TablesByEta {
public:
    template <class Make>
    std::vector<float> get(float eta, Make make) {
        const std::lock_guard lock(mutex_);
        if (const auto known = tables_.find(eta); known != tables_.end()) return known->second;
        if (tables_.size() >= kMost) tables_.clear();
        return tables_.emplace(eta, make()).first->second;
    }

private:
    /// A megabyte or so: who drags an index of refraction leaves a trail of them.
    static constexpr std::size_t kMost = 256;

    std::mutex mutex_;
    std::map<float, std::vector<float>> tables_;
};

}  // namespace

std::vector<float> lossless_albedo() {
    static const std::vector<float> table = make_table([](float) { return 1.0f; }, mirrored);
    return table;
}

std::vector<float> coat_albedo(float eta) {
    static TablesByEta tables;
    return tables.get(eta, [eta] {
        return make_table([eta](float cos_theta) { return fresnel_dielectric(cos_theta, eta); },
                          [eta](const Ggx& ggx, Vec3f wo, Vec3f m) {
                              return facet_reflectance(wo, m, eta) * mirrored(ggx, wo, m);
                          });
    });
}

std::vector<float> glass_albedo(float eta) {
    static TablesByEta tables;
    return tables.get(eta, [eta] {
        return make_table([](float) { return 1.0f; },
                          [eta](const Ggx& ggx, Vec3f wo, Vec3f m) {
                              const float f = facet_reflectance(wo, m, eta);
                              const float passed = f < 1.0f ? (1.0f - f) * refracted(ggx, wo, m, eta) : 0.0f;
                              return f * mirrored(ggx, wo, m) + passed;
                          });
    });
}

}  // namespace pl
