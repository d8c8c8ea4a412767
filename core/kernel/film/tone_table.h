// A tone curve followed by the sRGB encoding, as a table over the upper bits of a float. Display only. It is filled on the
// host, so that every back end shows the same codes, whatever its power function returns.
#pragma once

#include <bit>
#include <cstdint>

#include "core/kernel/base/span.h"
#include "core/kernel/film/tonemap.h"

namespace pl {

/// The table's entries, wherever they lie. The 8-bit result differs from exact rounding only where the exact value is
/// within kMaxError of a boundary between two codes.
struct ToneCodes {
    static constexpr float kMaxError = 0.13f;  ///< in codes: half a table step where the curve is steepest

    // Below 2^-16 even the code of the steepest curve rounds to 0; above 2^15 every curve has reached its end.
    static constexpr int kLowestExponent = -16;
    static constexpr int kHighestExponent = 15;
    static constexpr int kMantissaBits = 10;
    static constexpr std::uint32_t kShift = 23 - kMantissaBits;
    static constexpr std::uint32_t kSize = static_cast<std::uint32_t>(kHighestExponent - kLowestExponent)
                                           << kMantissaBits;
    static constexpr std::uint32_t kFirst = static_cast<std::uint32_t>(127 + kLowestExponent) << kMantissaBits;

    Span<const std::uint8_t> codes;  ///< kSize of them

    /// Code of an exposed, linear value. Not for NaN.
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
            // The middle of the values that share this entry.
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
