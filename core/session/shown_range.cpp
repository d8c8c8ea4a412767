#include "core/session/shown_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace pl {
namespace {

/// Smaller ones have no finite reciprocal.
constexpr float kSmallestHigh = std::numeric_limits<float>::min();

/// Of the red channel, which is the number in all views that show one; 1 if there is none.
float largest_value(const Snapshot& snapshot) {
    float largest = 0.0f;
    for (const Vec3f& pixel : snapshot.pixels)
        if (pixel.x > largest && pixel.x < kInfinity) largest = pixel.x;
    return largest >= kSmallestHigh ? largest : 1.0f;
}

}  // namespace

float ShownRange::scale() const { return 1.0f / high; }

bool shows_radiance(View view) { return view == View::Beauty || view == View::Direct || view == View::RadianceMap; }

ShownRange shown_range(const Snapshot& snapshot) {
    switch (snapshot.slot.view) {
    case View::Depth: return {largest_value(snapshot), ""};
    case View::Visits: return {largest_value(snapshot), "records"};
    case View::Irradiance: return {largest_value(snapshot), "radiance x sr"};
    case View::Entropy: return {std::log2(static_cast<float>(std::max(snapshot.bins, 2))), "bits"};
    case View::Change: return {largest_value(snapshot), "of the mean"};
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

std::string legend(View view, const ShownRange& range) {
    if (view != View::Depth && !is_heat_map(view)) return "";
    return fmt::format("0 to {:.6g}{}{}", range.high, range.unit.empty() ? "" : " ", range.unit);
}

}  // namespace pl
