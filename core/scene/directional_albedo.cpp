#include "core/scene/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/base/parallel.h"
#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/velvet.h"
#include "core/scene/facet_albedo.h"
#include "core/scene/piecewise_rule.h"

namespace pl {
namespace {

constexpr int kRows = AlbedoTable::kRoughnesses;
constexpr int kColumns = AlbedoTable::kCosines;
/// One row in so many is integrated, those between follow from cubic polynomials.
constexpr int kRowStep = 4;
static_assert((kRows - 1) % kRowStep == 0);
/// At grazing incidence hardly a facet is visible: a direction slightly above is used instead.
constexpr double kLeastCosine = 1e-5;

/// Inverse of AlbedoTable::row_share().
double roughness_at(double share) { return (1.6 - std::sqrt(1.6 * 1.6 - 2.4 * share)) / 1.2; }
double cosine_at(double share) { return share * share; }

/// Shares of the columns in the cosine-weighted mean of a row, 2 times the integral of mu times the value, with the interpolation of
/// AlbedoTable.
std::vector<double> shares_of_columns() {
    constexpr int kSteps = 32;
    std::vector<double> shares(kColumns);
    for (std::size_t i = 0; i + 1 < kColumns; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double begin =
                cosine_at((static_cast<double>(i) + static_cast<double>(k) / kSteps) / (kColumns - 1));
            const double end = cosine_at((static_cast<double>(i) + (k + 1.0) / kSteps) / (kColumns - 1));
            const double next = (k + 0.5) / kSteps;
            shares[i] += (end * end - begin * begin) * (1.0 - next);
            shares[i + 1] += (end * end - begin * begin) * next;
        }
    return shares;
}

/// Rows between those that are integrated: each value by the cubic polynomial through the four closest ones of its column.
void interpolate_rows(std::vector<float>& table) {
    constexpr int kKnown = (kRows - 1) / kRowStep + 1;
    for (int row = 0; row < kRows; ++row) {
        if (row % kRowStep == 0) continue;
        const int first = std::clamp(row / kRowStep - 1, 0, kKnown - 4);
        const double x = static_cast<double>(row) / kRowStep - first;
        const double weights[] = {(x - 1.0) * (x - 2.0) * (x - 3.0) / -6.0, x * (x - 2.0) * (x - 3.0) / 2.0,
                                  x * (x - 1.0) * (x - 3.0) / -2.0, x * (x - 1.0) * (x - 2.0) / 6.0};
        for (int c = 0; c < kColumns; ++c) {
            double value = 0.0;
            for (int k = 0; k < 4; ++k)
                value += weights[k] *
                         static_cast<double>(table[static_cast<std::size_t>((first + k) * kRowStep * kColumns + c)]);
            table[static_cast<std::size_t>(row * kColumns + c)] = static_cast<float>(std::clamp(value, 0.0, 1.0));
        }
    }
}

void add_means(std::vector<float>& table) {
    static const std::vector<double> shares = shares_of_columns();
    for (std::size_t row = 0; row < kRows; ++row) {
        double mean = 0.0;
        for (std::size_t c = 0; c < kColumns; ++c) mean += shares[c] * static_cast<double>(table[row * kColumns + c]);
        table[static_cast<std::size_t>(kRows) * kColumns + row] = static_cast<float>(mean);
    }
}

/// `albedo` of a roughness and a cosine.
template <class Albedo>
std::vector<float> make_table(Albedo albedo) {
    std::vector<float> table(AlbedoTable::kSize);
    for_chunks((kRows - 1) / kRowStep + 1, 1, usable_threads(), [&](IndexRange range) {
        const auto row = range.begin * kRowStep;
        const double roughness = roughness_at(static_cast<double>(row) / (kRows - 1));
        for (std::size_t c = 0; c < kColumns; ++c) {
            const double cosine = std::max(cosine_at(static_cast<double>(c) / (kColumns - 1)), kLeastCosine);
            table[row * kColumns + c] = static_cast<float>(albedo(roughness, cosine));
        }
    });
    interpolate_rows(table);
    add_means(table);
    return table;
}

/// smooth(cos) gives the row of roughness 0, facet_albedo() the others.
template <class Smooth>
std::vector<float> facet_table(FacetLight light, double eta, Smooth smooth) {
    return make_table([=](double roughness, double cosine) {
        const double albedo = roughness == 0.0 ? static_cast<double>(smooth(static_cast<float>(cosine)))
                                               : facet_albedo(light, roughness * roughness, cosine, eta);
        return std::min(albedo, 1.0);
    });
}

/// Cache of tables by eta. A table takes 10 to 60 ms of one thread, and every edit of a material repacks all materials.
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
    /// Capacity, about twelve megabytes: dragging an index of refraction adds a table per step.
    static constexpr std::size_t kMost = 128;

    std::mutex mutex_;
    std::map<float, std::vector<float>> tables_;
};

}  // namespace

std::vector<float> lossless_albedo() {
    static const std::vector<float> table = facet_table(FacetLight::Mirror, 1.0, [](float) { return 1.0f; });
    return table;
}

std::vector<float> coat_albedo(float eta) {
    static TablesByEta tables;
    return tables.get(eta, [eta] {
        return facet_table(FacetLight::Reflected, static_cast<double>(eta),
                           [eta](float cos_theta) { return fresnel_dielectric(cos_theta, eta); });
    });
}

std::vector<float> glass_albedo(float eta) {
    static TablesByEta tables;
    return tables.get(eta, [eta] {
        return facet_table(FacetLight::Scattered, static_cast<double>(eta), [](float) { return 1.0f; });
    });
}

std::vector<float> sheen_albedo() {
    // Rows below the least roughness serve the interpolation alone.
    static const std::vector<float> table = make_table([](double roughness, double cosine) {
        constexpr double kLeastRow = 0.2;
        const SheenFibers fibers(static_cast<float>(std::max(roughness, kLeastRow)));
        const Vec3f wo{Vec3d{std::sqrt(1.0 - cosine * cosine), 0.0, cosine}};
        static const QuadratureRule<16> heights = make_piece_rule<16>(true, false);
        static const QuadratureRule<12> azimuths = make_piece_rule<12>(false, false);
        double albedo = 0.0;
        for (std::size_t h = 0; h < 16; ++h)
            for (std::size_t a = 0; a < 12; ++a) {
                const double z = heights.at[h];
                const double radius = std::sqrt(1.0 - z * z);
                const double azimuth = glm::pi<double>() * azimuths.at[a];
                const Vec3f wi{Vec3d{radius * std::cos(azimuth), radius * std::sin(azimuth), z}};
                albedo += heights.weight[h] * azimuths.weight[a] * static_cast<double>(fibers.reflection(wo, wi));
            }
        return glm::two_pi<double>() * albedo;
    });
    return table;
}

}  // namespace pl
