// Directional albedo of a rough interface by single scattering, tabulated over roughness and angle by
// core/scene/directional_albedo.h; energy compensation for multiple scattering is based on it.
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

/// The two rows of an AlbedoTable around one roughness: found once at a vertex, and read for several directions.
struct AlbedoRow {
    static constexpr int kCosines = 160;

    const float* below = nullptr;  ///< [kCosines], and the row above behind it
    float share = 0.0f;            ///< weight of the row above
    float mean = 0.0f;             ///< over directions, weighted by the cosine

    PL_HD float at(float cos_theta) const {
        const float column = min_of(safe_sqrt(cos_theta), 1.0f) * static_cast<float>(kCosines - 1);
        const int left = min_of(static_cast<int>(column), kCosines - 2);
        const float* const first = below + left;
        const float to_right = column - static_cast<float>(left);
        const float lower = first[0] + (first[1] - first[0]) * to_right;
        const float upper = first[kCosines] + (first[kCosines + 1] - first[kCosines]) * to_right;
        return lower + (upper - lower) * share;
    }
};

/// One table of SceneView::directional_albedo, [roughness][sqrt(cos theta)], both from 0 to 1, followed by the cosine-weighted mean
/// over directions of every row. Columns are evenly spaced, rows in row_share(). From 2 degrees above the surface on the interpolation
/// is off by less than 4e-4.
struct AlbedoTable {
    static constexpr int kRoughnesses = 145;
    static constexpr int kCosines = AlbedoRow::kCosines;
    static constexpr int kSize = kRoughnesses * kCosines + kRoughnesses;

    const float* values = nullptr;

    PL_HD AlbedoRow row(float roughness) const {
        const float scaled = row_share(roughness) * static_cast<float>(kRoughnesses - 1);
        const int below = min_of(static_cast<int>(scaled), kRoughnesses - 2);
        const float share = scaled - static_cast<float>(below);
        const float* const means = values + kRoughnesses * kCosines + below;
        return {values + below * kCosines, share, means[0] + (means[1] - means[0]) * share};
    }

    /// From 0 to 1, fastest at nearly smooth interfaces: their albedo changes most at grazing angles.
    static PL_HD float row_share(float roughness) {
        const float r = clamp_to(roughness, 0.0f, 1.0f);
        return r * (1.6f - 0.6f * r);
    }
};

}  // namespace pl
