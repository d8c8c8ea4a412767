// The operands of learning in SIMD lanes by tables: the volumes of a block's vertices, and open training samples of paths.
#pragma once

#include "cpu/base/path_groups.h"

namespace pl {

/// A field of tables as plain pointers, of at least one volume.
struct VolumeRows {
    const KdNode* nodes;
    const float* mean_radiance;  ///< this and the next three: [volume]
    const float* direct;
    const float* inverse_reach;
    const float* bsdf_fraction;  ///< null: it is `fraction` everywhere
    float fraction;
    const float* row_cdf;
    std::int32_t side;  ///< of a table
};

/// Values of the volumes of 16 vertices; 0 at vertices without one.
struct alignas(64) ValueGroup {
    float value[kGroupSize] = {}, direct[kGroupSize] = {};  ///< value_at() and direct_at() of the field
};

/// The method's part of 16 paths: members as in OpenSample, and GuidedExpectation::first.
struct alignas(64) OpenGroup {
    std::int32_t volume[kGroupSize], cell[kGroupSize] = {};
    float bsdf_ratio[kGroupSize] = {};
    float first[kGroupSize] = {};

    OpenGroup() { std::fill_n(volume, kGroupSize, kNoVolume); }

    void start(std::uint32_t lane) {
        volume[lane] = kNoVolume;
        first[lane] = 0.0f;
    }
    void move(std::uint32_t lane, OpenGroup& to, std::uint32_t place) const {
        to.volume[place] = volume[lane];
        to.cell[place] = cell[lane];
        to.bsdf_ratio[place] = bsdf_ratio[lane];
        to.first[place] = first[lane];
    }
};

/// Numbers per path of a block.
struct alignas(64) BlockNumbers {
    float of[kPathBlock];
};

/// Rows of a block whose paths learn. `served`: the vertices that have a volume.
struct LearningRows {
    BlockRows block;
    BlockBits served;
    GuidedGroup* guided;
    ValueGroup* values;
    OpenGroup* open;
};

}  // namespace pl
