#include "core/session/methods.h"

#include <algorithm>
#include <array>

namespace pl {
namespace {

constexpr std::array<MethodInfo, kMethodCount> kMethods = [] {
    std::array<MethodInfo, kMethodCount> infos;
    any_method_kernel([&]<int kEntry>() {
        constexpr MethodId kId{method_index<kEntry>()};
        infos[kId.index] = TypeAt<kEntry, MethodList>::Info::kInfo;
        infos[kId.index].id = kId;
        return false;
    });
    return infos;
}();
static_assert(kMethods[MethodId::Default.index].name == "default");
static_assert(kMethods[MethodId::Precomputed.index].name == "precomputed");
static_assert(kMethods[MethodId::Reinforcement.index].name == "reinforcement");

constexpr std::array<ViewInfo, kViewCount> kViews{
    ViewInfo{View::Beauty, "beauty", "Beauty", "The full picture.", false, false},
    ViewInfo{View::Direct, "direct", "Direct light", "First surface, lit by shadow rays only.", false, false},
    ViewInfo{View::RadianceMap, "radiance-map", "Radiance map",
             "The learned irradiance shown directly: a biased preview.", true, true},
    ViewInfo{View::Voronoi, "voronoi", "Voronoi cells", "Which radiance volume serves each point.", true, false},
    ViewInfo{View::Normal, "normal", "Normals", "Shading normals, as 0.5 (n + 1).", false, false},
    ViewInfo{View::Albedo, "albedo", "Albedo", "Diffuse reflectance.", false, false},
    ViewInfo{View::Depth, "depth", "Depth", "Distance from the camera along the ray, in scene units.", false, false},
    ViewInfo{View::Visits, "visits", "Visits", "Training samples so far in all cells of each point's volume.", true,
             true},
    ViewInfo{View::Irradiance, "irradiance", "Irradiance", "Learned irradiance of each point's volume.", true, true},
    ViewInfo{View::Entropy, "entropy", "Entropy",
             "How undecided each volume's table is, in bits; log2 of the bins where it is uniform.", true, true},
    ViewInfo{View::BsdfShare, "bsdf-share", "BSDF share", "Learned share of directions that the BSDF chooses.", true,
             true},
    ViewInfo{View::Change, "change", "Change",
             "How much the cells of each volume last changed, relative to its mean radiance.", true, true},
    ViewInfo{View::Unvisited, "unvisited", "Unvisited", "Share of each volume's cells without a training sample.",
             true, true},
};

}  // namespace

std::span<const MethodInfo> all_methods() { return kMethods; }
std::span<const ViewInfo> all_views() { return kViews; }

const MethodInfo& info_of(MethodId id) { return kMethods[static_cast<std::size_t>(id)]; }
MethodId baseline_method() { return std::ranges::find(kMethods, false, &MethodInfo::uses_field)->id; }
MethodId learning_method() { return std::ranges::find(kMethods, true, &MethodInfo::learns)->id; }
MethodId field_owner(MethodId method) { return info_of(method).uses_field ? method : learning_method(); }
const ViewInfo& info_of(View id) { return kViews[static_cast<std::size_t>(id)]; }

std::optional<MethodId> method_by_name(std::string_view name) {
    const auto it = std::ranges::find(kMethods, name, &MethodInfo::name);
    if (it == kMethods.end()) return std::nullopt;
    return it->id;
}

std::optional<View> view_by_name(std::string_view name) {
    const auto it = std::ranges::find(kViews, name, &ViewInfo::name);
    if (it == kViews.end()) return std::nullopt;
    return it->id;
}

}  // namespace pl
