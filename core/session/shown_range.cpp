#include "core/session/shown_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace pl {
namespace {

/// Smaller values have no finite reciprocal.
constexpr float kSmallestHigh = std::numeric_limits<float>::min();

/// The red channel, which holds the number in all views of numbers; 0 if no value is positive and finite.
float largest_value(const Snapshot& snapshot) {
    float largest = 0.0f;
    for (const Vec3f& pixel : snapshot.pixels)
        if (pixel.x > largest && pixel.x < kInfinity) largest = pixel.x;
    return largest;
}

}  // namespace

float ShownRange::scale() const { return 1.0f / high; }

bool shows_radiance(View view) { return view == View::Beauty || view == View::Direct || view == View::RadianceMap; }

DisplaySettings display_of(View view, const DisplaySettings& asked) {
    return shows_radiance(view) ? asked : DisplaySettings{};
}

bool ends_at_largest(View view) {
    return view == View::Depth || view == View::Visits || view == View::Irradiance || view == View::Change;
}

ShownRange shown_range(View view, int bins, float largest) {
    const float high = largest >= kSmallestHigh ? largest : 1.0f;
    switch (view) {
    case View::Depth: return {high, ""};
    case View::Visits: return {high, "records"};
    case View::Irradiance: return {high, "radiance x sr"};
    case View::Entropy: return {std::log2(static_cast<float>(std::max(bins, 2))), "bits"};
    case View::Change: return {high, "of the mean"};
    case View::BsdfShare:
    case View::Unvisited: return {1.0f, "(share)"};
    case View::Beauty:
    case View::Direct:
    case View::RadianceMap:
    case View::Voronoi:
    case View::Normal:
    case View::Albedo: break;
    }
    return {};
}

ShownRange shown_range(const Snapshot& snapshot) {
    const View view = snapshot.slot.view;
    return shown_range(view, snapshot.bins, ends_at_largest(view) ? largest_value(snapshot) : 0.0f);
}

FrameStyle frame_style(View view, const DisplaySettings& asked, const ShownRange& range) {
    const DisplaySettings display = display_of(view, asked);
    return {.scale = std::exp2(display.exposure_ev) * range.scale(),
            .curve = display.curve,
            .heat = is_heat_map(view) ? 1u : 0u};
}

std::string legend(View view, const ShownRange& range) {
    if (view != View::Depth && !is_heat_map(view)) return "";
    return fmt::format("0 to {:.6g}{}{}", range.high, range.unit.empty() ? "" : " ", range.unit);
}

}  // namespace pl
