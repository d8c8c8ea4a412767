// From a snapshot to the 8-bit pixels of the window. Tone mapping happens here, so that exposure works while
// rendering is paused and never restarts anything.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/kernel/film/tonemap.h"
#include "ui/published_frame.h"

namespace pl {

/// One tone curve followed by the sRGB encoding, as a table over the upper bits of a float. The 8-bit result differs
/// from exact rounding only where the exact value is within kMaxError of a boundary between two codes.
class ToneTable {
public:
    static constexpr float kMaxError = 0.13f;  ///< in codes: half a table step where the curve is steepest

    explicit ToneTable(ToneCurve curve);

    ToneCurve curve() const { return curve_; }

    /// Code of an exposed, linear value. Not for NaN.
    std::uint8_t operator()(float exposed) const;

private:
    // Below 2^-16 even the code of the steepest curve rounds to 0; above 2^15 every curve has reached its end.
    static constexpr int kLowestExponent = -16;
    static constexpr int kHighestExponent = 15;
    static constexpr int kMantissaBits = 10;
    static constexpr std::uint32_t kShift = 23 - kMantissaBits;
    static constexpr std::size_t kSize = static_cast<std::size_t>(kHighestExponent - kLowestExponent)
                                         << kMantissaBits;
    static constexpr std::uint32_t kFirst = static_cast<std::uint32_t>(127 + kLowestExponent) << kMantissaBits;

    ToneCurve curve_;
    std::array<std::uint8_t, kSize> codes_;
};

/// Exposure and curve as far as they apply to a view: data views such as normals are shown as they are.
DisplaySettings display_of(View view, const DisplaySettings& asked);

/// `colors` is a picture of View::Voronoi. Both functions expect the table of ToneCurve::Clamp.
CellImage make_cell_image(const Snapshot& colors, const ToneTable& table);
std::uint32_t cell_color(std::int32_t volume, const ToneTable& table);

/// What is laid over the picture.
struct CellOverlay {
    const CellImage* cells = nullptr;       ///< ignored if null or of another size than the picture
    float opacity = 0.0f;                   ///< of the cells' colors
    std::optional<std::uint32_t> outlined;  ///< cell_color() of the cell that gets an outline
};

/// Writes ARGB8888 rows, `pitch` pixels apart. `scale` multiplies linear values: exposure and ShownRange::scale(). Heat maps
/// get the colors of heat_color().
void write_picture(const Snapshot& snapshot, float scale, const ToneTable& table, const CellOverlay& overlay,
                   std::uint32_t* out, std::size_t pitch);

}  // namespace pl
