#include "core/scene/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/base/parallel_chunks.h"
#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"

namespace pl {
namespace {

/// Samples per table entry, for an error of about 1e-3. A regular grid of as many points has ten times the error.
constexpr int kSamples = 1024;
/// Rows below this roughness hold the values of the smooth interface.
constexpr float kSmooth = 1e-3f;

/// Point i of the R2 sequence in the unit square.   [Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
/// Sequences"]
Vec2f spread_point(int i) {
    const double x = 0.5 + i * 0.7548776662466927;
    const double y = 0.5 + i * 0.5698402909980532;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

/// Mean of value(ggx, wo, m) over the normals m visible from a direction.
template <class Value>
float mean_over_facets(float roughness, float cos_theta, Value value) {
    const Ggx ggx{{square(roughness)}};
    const Vec3f wo{safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta};
    double sum = 0.0;
    for (int i = 0; i < kSamples; ++i) sum += static_cast<double>(value(ggx, wo, ggx.sample(wo, spread_point(i))));
    return static_cast<float>(sum / kSamples);
}

/// Weight of a reflection with Fresnel reflectance 1: f cos / pdf = G2 / G1, 0 below the horizon.   [Heitz 2018, eq.
/// 19]
float mirrored(const Ggx& ggx, Vec3f wo, Vec3f m) {
    const Vec3f wi = reflect_at(wo, m);
    return wi.z > 0.0f ? ggx.visible(wo, wi) / ggx.visible(wo) : 0.0f;
}
float refracted(const Ggx& ggx, Vec3f wo, Vec3f m, float eta) {
    const Vec3f wi = refract_at(wo, m, eta);
    return wi.z < 0.0f ? ggx.visible(wo, wi) / ggx.visible(wo) : 0.0f;
}

/// Cosine-weighted mean of a row: 2 times the integral of mu times the value, with the interpolation of AlbedoTable.
float mean_of_row(const float* row) {
    constexpr int kSteps = 32;
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i + 1 < AlbedoTable::kCosines; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double share = (k + 0.5) / kSteps;
            const double root = (i + share) / (AlbedoTable::kCosines - 1);
            const double weight = root * root * root;  // mu dmu for mu = root^2
            sum += weight * (static_cast<double>(row[i]) * (1.0 - share) + static_cast<double>(row[i + 1]) * share);
            weights += weight;
        }
    return static_cast<float>(sum / weights);
}

/// smooth(cos) gives the row of roughness 0; `value`, as in mean_over_facets(), the others.
template <class Smooth, class Value>
std::vector<float> make_table(Smooth smooth, Value value) {
    std::vector<float> table(AlbedoTable::kSize);
    for_chunks(AlbedoTable::kRoughnesses, 1, usable_threads(), [&](IndexRange row) {
        const float roughness = static_cast<float>(row.begin) / (AlbedoTable::kRoughnesses - 1);
        float* const values = table.data() + row.begin * AlbedoTable::kCosines;
        for (int c = 0; c < AlbedoTable::kCosines; ++c) {
            // At grazing incidence hardly a facet is visible: a direction slightly above is used instead.
            const float cos_theta = max_of(square(static_cast<float>(c) / (AlbedoTable::kCosines - 1)), 1e-4f);
            const float returned =
                roughness < kSmooth ? smooth(cos_theta) : mean_over_facets(roughness, cos_theta, value);
            values[c] = std::min(returned, 1.0f);
        }
        table[AlbedoTable::kRoughnesses * AlbedoTable::kCosines + row.begin] = mean_of_row(values);
    });
    return table;
}

float facet_reflectance(Vec3f wo, Vec3f m, float eta) {
    return fresnel_dielectric(clamp_to(glm::dot(wo, m), 0.0f, 1.0f), eta);
}

/// Cache of tables by eta. A table takes about 33 ms of one thread, and every edit of a material repacks all materials.
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
    /// Capacity, about a megabyte: dragging an index of refraction adds a table per step.
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
