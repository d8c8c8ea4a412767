// With the normals m that are visible from wo the albedo is the mean of F G2(wo, wi) / G1(wo) over them.   [Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals", eq. 19] They are h = c + v stretched by alpha, v being wo stretched likewise, for points c spread evenly
// over the cap c.z > -v.z of the unit sphere.   [Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"] So the mean is
// an integral over the height c.z and the azimuth of c.
//
// The integrand has kinks at three curves: the mirrored and the refracted direction at the horizon, and the onset of total reflection. At
// one height each is one azimuth, because m, and all that follows from it, depends on the azimuth by h.v alone. The integral over the
// azimuth is cut there, that over the height at facets in the plane of incidence, with which azimuths of kinks come and go.
#include "core/scene/facet_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "core/scene/piecewise_rule.h"

namespace pl {
namespace {

/// Heights of a piece. There are more pieces where reflection may be total.
constexpr std::size_t kHeights = 12;
constexpr std::size_t kHeightsOfMorePieces = 8;
constexpr std::size_t kAzimuths = 12;

/// The light of one facet in single precision, good enough and twice as fast in vectors: cos_m is wo.m.
struct FacetInterface {
    float alpha2, cos_o, eta;
    float lambda;  ///< 1 + Lambda(wo)

    /// G2 / G1 for the cosine of the other direction: 1 + Lambda(wo) over 1 + Lambda(wo) + Lambda(wi).
    float shown(float cos_i) const {
        const float c = std::min(std::max(cos_i, 1e-30f), 1.0f);
        const float root = std::sqrt(c * c + alpha2 * (1.0f - c * c));
        return c * lambda / (c * lambda + 0.5f * (root - c));
    }
    float mirrored(float cos_m, float m_z) const { return shown(2.0f * cos_m * m_z - cos_o); }
    /// Reflected light, given the light `mirror` of a mirror, and `counted` times the refracted light.
    float scattered(float cos_m, float m_z, float mirror, float counted) const {
        const float cos_t = std::sqrt(std::max(1.0f - (1.0f - cos_m * cos_m) / (eta * eta), 0.0f));
        const float parallel = (eta * cos_m - cos_t) / (eta * cos_m + cos_t);
        const float perpendicular = (cos_m - eta * cos_t) / (cos_m + eta * cos_t);
        const float reflectance = 0.5f * (parallel * parallel + perpendicular * perpendicular);
        const float refracted = shown(cos_o / eta - (cos_m / eta - cos_t) * m_z);
        return reflectance * mirror + counted * (1.0f - reflectance) * refracted;
    }
};

/// Cosine of angles in [0, pi], by a Taylor series around the middle.
float series_cosine(float angle) {
    const float x = static_cast<float>(0.5 * glm::pi<double>()) - angle;
    const float x2 = x * x;
    const float tail = 1.0f / 362880.0f - x2 * (1.0f / 39916800.0f);
    return x * (1.0f - x2 * (1.0f / 6.0f - x2 * (1.0f / 120.0f - x2 * (1.0f / 5040.0f - x2 * tail))));
}

/// Facets as wo sees them; wo is in the plane of x and z.
class VisibleFacets {
public:
    VisibleFacets(FacetLight light, double alpha, double cos_o, double eta)
        : mirrors_(light == FacetLight::Mirror), refracts_(light == FacetLight::Scattered),
          may_reflect_totally_(!mirrors_ && eta < 1.0), alpha_(alpha), alpha2_(alpha * alpha), cos_o_(cos_o),
          sin_o_(std::sqrt(std::max(1.0 - cos_o * cos_o, 0.0))), eta_(eta),
          length_(std::sqrt(alpha2_ * sin_o_ * sin_o_ + cos_o * cos_o)), v_x_(alpha * sin_o_ / length_),
          v_z_(cos_o / length_), interface_{static_cast<float>(alpha2_), static_cast<float>(cos_o),
                                            static_cast<float>(eta),
                                            static_cast<float>(0.5 + 0.5 * length_ / cos_o)} {}

    double albedo() const {
        const Pieces heights = pieces_of_heights();
        double sum = 0.0;
        for (std::size_t piece = 0; piece < heights.count(); ++piece) {
            const double begin = heights.begin(piece);
            const double length = heights.length(piece);
            // At the lowest height facets are seen edge-on, and change as fast as at a kink.
            const bool ends = heights.is_last(piece);
            sum += length * (may_reflect_totally_
                                 ? mean_of_rings(piece_rule<kHeightsOfMorePieces>(true, !ends), begin, length)
                                 : mean_of_rings(piece_rule<kHeights>(true, !ends), begin, length));
        }
        return sum / (1.0 + v_z_);
    }

private:
    /// Facets of one height of c.
    struct Ring {
        double h_z;
        double middle, reach;  ///< h.v is middle + reach cos(azimuth)
        double rest;           ///< (1 - alpha^2) h_z^2, see facet()

        double azimuth(double h_v) const {
            const double scaled = h_v - middle;
            if (!(std::fabs(scaled) < reach)) return scaled > 0.0 ? 0.0 : glm::pi<double>();
            return std::acos(scaled / reach);
        }
    };

    Pieces pieces_of_heights() const {
        Pieces heights(-v_z_, 1.0);
        const double critical = may_reflect_totally_ ? std::sqrt(1.0 - eta_ * eta_) : 0.0;
        for (const double side : {-1.0, 1.0}) {
            heights.cut(height_of(sin_o_ + side, cos_o_));
            if (!may_reflect_totally_) continue;
            heights.cut(
                height_of(critical * sin_o_ - side * eta_ * cos_o_, critical * cos_o_ + side * eta_ * sin_o_));
            if (refracts_) heights.cut(height_of(sin_o_ + side * eta_, cos_o_));
        }
        return heights;
    }
    /// The height of c for a normal in the plane of incidence, of any length; out of range if wo does not see it.
    double height_of(double m_x, double m_z) const {
        const double up = m_z < 0.0 ? -1.0 : 1.0;
        const double h_x = up * m_x / alpha_;
        const double h_z = up * m_z;
        const double along = h_x * v_x_ + h_z * v_z_;
        return along > 0.0 ? 2.0 * along * h_z / (h_x * h_x + h_z * h_z) - v_z_ : -1.0;
    }

    /// h.v above which the mirrored direction is above the horizon.
    double mirror_limit(const Ring& ring) const {
        const double steepness = ring.h_z - alpha2_ * v_z_;
        return steepness > 0.0 ? v_z_ * ring.rest / (2.0 * steepness) : ring.middle + 2.0 * ring.reach;
    }
    /// h.v below which reflection is total.
    double total_limit(const Ring& ring) const {
        const double scale = (1.0 - eta_ * eta_) / (length_ * length_);
        const double half = alpha2_ * scale;
        return half + std::sqrt(half * half + scale * ring.rest);
    }
    /// h.v above which the refracted direction is below the horizon, given total_limit(). By false position [Dowell and Jarratt 1971,
    /// "A Modified Regula Falsi Method for Computing the Root of an Equation"].
    double refraction_limit(const Ring& ring, double total) const {
        double low = std::max(total, ring.middle - ring.reach);
        double high = ring.middle + ring.reach;
        if (!(low < high)) return low;
        double above = refracted_z(ring, low);
        double below = refracted_z(ring, high);
        if (above <= 0.0) return low;
        if (below >= 0.0) return high;
        double h_v = low;
        for (int i = 0; i < 6; ++i) {
            h_v = (low * below - high * above) / (below - above);
            const double z = refracted_z(ring, h_v);
            (z > 0.0 ? low : high) = h_v;
            (z > 0.0 ? above : below) = z;
            (z > 0.0 ? below : above) *= 0.5;
        }
        return h_v;
    }
    /// z of the refracted direction; falls with h.v. m is as in arc_mean().
    double refracted_z(const Ring& ring, double h_v) const {
        const double scale = 1.0 / std::sqrt(2.0 * alpha2_ * h_v + ring.rest);
        const double cos_m = std::min(length_ * h_v * scale, 1.0);
        const double cos_t = std::sqrt(std::max(1.0 - (1.0 - cos_m * cos_m) / (eta_ * eta_), 0.0));
        return (cos_m / eta_ - cos_t) * ring.h_z * scale - cos_o_ / eta_;
    }

    template <std::size_t N>
    double mean_of_rings(const QuadratureRule<N>& rule, double begin, double length) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < N; ++i) sum += rule.weight[i] * ring_mean(begin + length * rule.at[i]);
        return sum;
    }
    double ring_mean(double height) const {
        const double h_z = height + v_z_;
        const double radius = std::sqrt(std::max(1.0 - height * height, 0.0));
        const Ring ring{h_z, 1.0 + v_z_ * height, v_x_ * radius, (1.0 - alpha2_) * h_z * h_z};
        Pieces azimuths(0.0, glm::pi<double>());
        const double mirrored = ring.azimuth(mirror_limit(ring));
        azimuths.cut(mirrored);
        double refracted = refracts_ ? glm::pi<double>() : 0.0;
        if (may_reflect_totally_) {
            const double total = total_limit(ring);
            azimuths.cut(ring.azimuth(total));
            if (refracts_) azimuths.cut(refracted = ring.azimuth(refraction_limit(ring, total)));
        }
        double sum = 0.0;
        for (std::size_t piece = 0; piece < azimuths.count(); ++piece) {
            const double begin = azimuths.begin(piece);
            if (begin >= mirrored && begin >= refracted) break;
            const auto& rule = piece_rule<kAzimuths>(!azimuths.is_first(piece), !azimuths.is_last(piece));
            sum += azimuths.length(piece) *
                   arc_mean(ring, rule, begin, azimuths.length(piece), begin < mirrored, begin < refracted);
        }
        return sum / glm::pi<double>();
    }
    /// m is (alpha h.x, alpha h.y, h.z) over its length, whose square is 2 alpha^2 h.v + (1 - alpha^2) h.z^2 because h^2 is 2 h.v.
    double arc_mean(const Ring& ring, const QuadratureRule<kAzimuths>& rule, double begin, double length,
                    bool has_mirrored, bool has_refracted) const {
        std::array<float, kAzimuths> cos_m, m_z, light{};
        for (std::size_t i = 0; i < kAzimuths; ++i) {
            const float turn = series_cosine(static_cast<float>(begin + length * rule.at[i]));
            const float h_v = static_cast<float>(ring.middle) + static_cast<float>(ring.reach) * turn;
            const float length2 = 2.0f * interface_.alpha2 * h_v + static_cast<float>(ring.rest);
            const float scale = 1.0f / std::sqrt(std::max(length2, 1e-30f));
            cos_m[i] = std::min(std::max(static_cast<float>(length_) * h_v * scale, 1e-6f), 1.0f);
            m_z[i] = static_cast<float>(ring.h_z) * scale;
        }
        if (has_mirrored)
            for (std::size_t i = 0; i < kAzimuths; ++i) light[i] = interface_.mirrored(cos_m[i], m_z[i]);
        if (!mirrors_) {
            const float counted = has_refracted ? 1.0f : 0.0f;
            for (std::size_t i = 0; i < kAzimuths; ++i)
                light[i] = interface_.scattered(cos_m[i], m_z[i], light[i], counted);
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < kAzimuths; ++i) sum += rule.weight[i] * static_cast<double>(light[i]);
        return sum;
    }

    bool mirrors_, refracts_, may_reflect_totally_;
    double alpha_, alpha2_, cos_o_, sin_o_, eta_;
    double length_;  ///< of wo after the stretch that gives v, which is a unit vector
    double v_x_, v_z_;
    FacetInterface interface_;
};

}  // namespace

double facet_albedo(FacetLight light, double alpha, double cos_o, double eta) {
    return VisibleFacets(light, alpha, cos_o, eta).albedo();
}

}  // namespace pl
