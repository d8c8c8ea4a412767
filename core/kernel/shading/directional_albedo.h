// Directional albedo of a rough interface by single scattering, tabulated over roughness and angle by
// core/scene/directional_albedo.h; energy compensation for multiple scattering is based on it.
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

/// One table of SceneView::directional_albedo, [roughness][sqrt(cos theta)], both from 0 to 1, followed by the cosine-weighted mean
/// over directions of every row. Columns are evenly spaced, rows in row_share(). From 2 degrees above the surface on the interpolation
/// is off by less than 4e-4.
struct AlbedoTable {
    static constexpr int kRoughnesses = 145;
    static constexpr int kCosines = 160;
    static constexpr int kSize = kRoughnesses * kCosines + kRoughnesses;

    const float* values = nullptr;

    PL_HD float at(float roughness, float cos_theta) const {
        const Step row = step_of(row_share(roughness), kRoughnesses);
        const Step column = step_of(min_of(safe_sqrt(cos_theta), 1.0f), kCosines);
        return mix_rows(row, in_row(row.below, column), in_row(row.below + 1, column));
    }
    PL_HD float mean(float roughness) const {
        const Step row = step_of(row_share(roughness), kRoughnesses);
        const float* means = values + kRoughnesses * kCosines;
        return mix_rows(row, means[row.below], means[row.below + 1]);
    }

    /// From 0 to 1, fastest at nearly smooth interfaces: their albedo changes most at grazing angles.
    static PL_HD float row_share(float roughness) {
        const float r = clamp_to(roughness, 0.0f, 1.0f);
        return r * (1.6f - 0.6f * r);
    }

private:
    struct Step {
        int below;
        float share;  ///< weight of the next entry
    };
    static PL_HD Step step_of(float share, int count) {
        const float scaled = share * static_cast<float>(count - 1);
        const int below = min_of(static_cast<int>(scaled), count - 2);
        return {below, scaled - static_cast<float>(below)};
    }
    PL_HD float in_row(int row, Step column) const {
        const float* first = values + row * kCosines + column.below;
        return first[0] + (first[1] - first[0]) * column.share;
    }
    static PL_HD float mix_rows(Step row, float below, float above) { return below + (above - below) * row.share; }
};

}  // namespace pl
