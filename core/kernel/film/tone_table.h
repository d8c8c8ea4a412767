// Tone curve and sRGB encoding, tabulated over the upper bits of a float. Display only. Filled on the host, so that
// the 8-bit codes do not depend on the power function of a back end.
#pragma once

#include <bit>
#include <cstdint>

#include "core/kernel/base/span.h"
#include "core/kernel/film/tonemap.h"

namespace pl {

/// View of the table, in host or device memory. Codes differ from exact rounding only if the exact value is within
/// kMaxError of the boundary between two codes.
struct ToneCodes {
    static constexpr float kMaxError = 0.13f;  ///< in codes: half a table step where the curve is steepest

    // Below 2^-16 every curve rounds to code 0; above 2^15 every curve has reached its limit.
    static constexpr int kLowestExponent = -16;
    static constexpr int kHighestExponent = 15;
    static constexpr int kMantissaBits = 10;
    static constexpr std::uint32_t kShift = 23 - kMantissaBits;
    static constexpr std::uint32_t kSize = static_cast<std::uint32_t>(kHighestExponent - kLowestExponent)
                                           << kMantissaBits;
    static constexpr std::uint32_t kFirst = static_cast<std::uint32_t>(127 + kLowestExponent) << kMantissaBits;

    Span<const std::uint8_t> codes;  ///< kSize of them

    /// 8-bit code of a linear value after exposure, which must not be NaN.
    PL_HD std::uint8_t operator()(float exposed) const {
        const float positive = exposed > 0.0f ? exposed : 0.0f;
        const std::uint32_t index = std::bit_cast<std::uint32_t>(positive) >> kShift;
        return codes[min_of(max_of(index, kFirst), kFirst + kSize - 1) - kFirst];
    }
};

/// Owner of the entries, on the host.
class ToneTable {
public:
    explicit ToneTable(ToneCurve curve) : curve_(curve) {
        for (std::uint32_t i = 0; i < ToneCodes::kSize; ++i) {
            // The center of the interval of this entry.
            const std::uint32_t bits =
                ((i + ToneCodes::kFirst) << ToneCodes::kShift) + (1u << (ToneCodes::kShift - 1));
            const float encoded = encode_srgb(apply_curve(curve, std::bit_cast<float>(bits)));
            codes_[i] = static_cast<std::uint8_t>(std::lround(255.0f * encoded));
        }
    }

    ToneCurve curve() const { return curve_; }
    ToneCodes view() const { return {{codes_, ToneCodes::kSize}}; }
    std::uint8_t operator()(float exposed) const { return view()(exposed); }

private:
    ToneCurve curve_;
    std::uint8_t codes_[ToneCodes::kSize];
};

}  // namespace pl
