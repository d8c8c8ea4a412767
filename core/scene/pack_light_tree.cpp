#include "core/scene/pack_light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

constexpr double kPi64 = 3.14159265358979323846;
constexpr int kBins = 12;
/// Deeper nodes are split in equal halves to bound the length of trails: up to 2^32 lights need 32 more levels.
constexpr int kMostUnevenLevels = kMostLightLevels - 32;

/// The directions within an angle of an axis.
struct Cone {
    Vec3d axis{0.0, 0.0, 1.0};
    double angle = 0.0;

    /// Union with another cone: the smallest cone around both.   [Pharr, Jakob, Humphreys, Physically Based
    /// Rendering, 4th ed., 3.8.4]
    void add(const Cone& other) {
        const double between = std::acos(std::clamp(glm::dot(axis, other.axis), -1.0, 1.0));
        if (std::min(between + other.angle, kPi64) <= angle) return;
        if (std::min(between + angle, kPi64) <= other.angle) {
            *this = other;
            return;
        }
        const double wanted = 0.5 * (angle + between + other.angle);
        const Vec3d across = glm::cross(axis, other.axis);
        if (wanted >= kPi64 || !(glm::length(across) > 0.0)) {
            angle = kPi64;
            return;
        }
        const double turn = wanted - angle;
        const Vec3d sideways = glm::cross(glm::normalize(across), axis);
        axis = glm::normalize(std::cos(turn) * axis + std::sin(turn) * sideways);
        angle = wanted;
    }

    /// Orientation measure: the integral over the sphere of the largest cosine to a direction of the cone.   [Conty
    /// Estevez and Kulla 2018, eq. 1]
    double measure() const {
        const double wide = std::min(angle + 0.5 * kPi64, kPi64);
        const double sine = std::sin(angle);
        const double cosine = std::cos(angle);
        return 2.0 * kPi64 * (1.0 - cosine) +
               0.5 * kPi64 * (2.0 * wide * sine - std::cos(angle - 2.0 * wide) - 2.0 * angle * sine + cosine);
    }
};

/// Bounds of a set of lights.
struct LightBounds {
    Vec3d low{std::numeric_limits<double>::infinity()};
    Vec3d high{-std::numeric_limits<double>::infinity()};
    Cone cone;
    double power = 0.0;

    void add(const LightBounds& other) {
        if (other.power == 0.0) return;
        if (power == 0.0) {
            *this = other;
            return;
        }
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
        cone.add(other.cone);
        power += other.power;
    }

    Vec3d center() const { return 0.5 * (low + high); }

    /// Surface-area orientation heuristic: power x area measure x orientation measure.   [Conty Estevez and Kulla
    /// 2018]
    double cost() const {
        if (power == 0.0) return 0.0;
        const Vec3d d = high - low;
        return power * cone.measure() * (d.x * d.y + d.y * d.z + d.z * d.x);
    }
};

struct LightItem {
    LightBounds bounds{};
    std::uint32_t light = 0;
    double area = 0.0;
};

/// Maps light centers along one axis to bins; monotone, so that equal centers share a bin.
struct LightBinning {
    int axis;
    double low;
    double scale;

    int operator()(const LightItem& item) const {
        return std::min(static_cast<int>((item.bounds.center()[axis] - low) * scale), kBins - 1);
    }
};

struct LightSplit {
    LightBinning binning{};
    int bin = -1;  ///< last bin of the first child; -1: none found
    double cost = std::numeric_limits<double>::infinity();
};

class TreeBuilder {
public:
    TreeBuilder(std::vector<LightItem> items, HostScene& packed) : items_(std::move(items)), packed_(packed) {}

    void build() {
        packed_.light_nodes.reserve(2 * items_.size() - 1);
        add_node(0, items_.size(), 0, 0);
    }

private:
    void add_node(std::size_t first, std::size_t last, int level, std::uint64_t trail) {
        LightBounds bounds;
        for (std::size_t i = first; i < last; ++i) bounds.add(items_[i].bounds);
        const std::size_t node = packed_.light_nodes.size();
        packed_.light_nodes.push_back(packed_node(bounds));
        if (last - first == 1) {
            packed_.light_nodes[node].is_leaf = 1;
            packed_.light_nodes[node].next = items_[first].light;
            packed_.light_places[items_[first].light].trail = trail;
            return;
        }
        const std::size_t middle = partition(first, last, level, bounds);
        add_node(first, middle, level + 1, trail);
        packed_.light_nodes[node].next = static_cast<std::uint32_t>(packed_.light_nodes.size());
        add_node(middle, last, level + 1, trail | std::uint64_t{1} << level);
    }

    /// Partitions the lights between two children, neither of them empty; returns the begin of the second.
    std::size_t partition(std::size_t first, std::size_t last, int level, const LightBounds& bounds) {
        const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = items_.begin() + static_cast<std::ptrdiff_t>(last);
        const LightSplit split = level < kMostUnevenLevels ? best_split(first, last) : LightSplit{};
        if (split.bin >= 0)
            return static_cast<std::size_t>(
                std::partition(begin, end, [&](const LightItem& item) { return split.binning(item) <= split.bin; }) -
                items_.begin());
        const Vec3d size = bounds.high - bounds.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t middle = first + (last - first) / 2;
        std::nth_element(begin, items_.begin() + static_cast<std::ptrdiff_t>(middle), end,
                         [axis](const LightItem& a, const LightItem& b) {
                             const double x = a.bounds.center()[axis];
                             const double y = b.bounds.center()[axis];
                             return x != y ? x < y : a.light < b.light;
                         });
        return middle;
    }

    LightSplit best_split(std::size_t first, std::size_t last) const {
        Vec3d low{std::numeric_limits<double>::infinity()};
        Vec3d high{-std::numeric_limits<double>::infinity()};
        for (std::size_t i = first; i < last; ++i) {
            low = glm::min(low, items_[i].bounds.center());
            high = glm::max(high, items_[i].bounds.center());
        }
        LightSplit best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(high[axis] > low[axis])) continue;
            const LightBinning binning{axis, low[axis], kBins / (high[axis] - low[axis])};
            best_on_axis(binning, first, last, best);
        }
        return best;
    }

    void best_on_axis(const LightBinning& binning, std::size_t first, std::size_t last, LightSplit& best) const {
        std::array<LightBounds, kBins> bins;
        for (std::size_t i = first; i < last; ++i)
            bins[static_cast<std::size_t>(binning(items_[i]))].add(items_[i].bounds);
        std::array<double, kBins> above{};  // cost of all bins above
        LightBounds sum;
        for (std::size_t i = kBins - 1; i > 0; --i) {
            sum.add(bins[i]);
            above[i - 1] = sum.cost();
        }
        sum = {};
        for (int i = 0; i + 1 < kBins; ++i) {
            sum.add(bins[static_cast<std::size_t>(i)]);
            const double cost = sum.cost() + above[static_cast<std::size_t>(i)];
            // The outermost bins are never empty, so neither child is.
            if (cost < best.cost) best = {binning, i, cost};
        }
    }

    static LightNode packed_node(const LightBounds& bounds) {
        const Vec3f center{bounds.center()};
        // Around the rounded center, and rounded up.
        const Vec3d far = glm::max(glm::abs(bounds.high - Vec3d{center}), glm::abs(bounds.low - Vec3d{center}));
        const auto radius = static_cast<float>(glm::length(far) * (1.0 + 1e-6));
        return {.center = center,
                .radius = radius,
                .axis = Vec3f{bounds.cone.axis},
                .cos_spread = static_cast<float>(std::cos(bounds.cone.angle)),
                .power = static_cast<float>(bounds.power)};
    }

    std::vector<LightItem> items_;
    HostScene& packed_;
};

LightItem item_of(const HostScene& packed, std::uint32_t light) {
    const std::uint32_t primitive = packed.lights[light].primitive;
    const Triangle& triangle = packed.triangles[primitive];
    const Material& material = packed.materials[triangle.material];
    const TriangleCorners corners(view_of(packed.positions), triangle);
    LightItem item{.light = light, .area = 0.5 * glm::length(corners.cross())};
    for (const Vec3d corner : corners.p) {
        item.bounds.low = glm::min(item.bounds.low, corner);
        item.bounds.high = glm::max(item.bounds.high, corner);
    }
    item.bounds.cone = {Vec3d{packed.planes[primitive].normal}, material.two_sided_emission != 0 ? kPi64 : 0.0};
    item.bounds.power = item.area * static_cast<double>(luminance(material.emission));
    return item;
}

/// Roots of the clusters: from the tree's root on, the node with the largest power times radius is replaced by its children.
std::vector<std::uint32_t> cluster_roots(const std::vector<LightNode>& nodes) {
    const auto spread = [&](std::uint32_t node) {
        return nodes[node].is_leaf != 0 ? -1.0f : nodes[node].power * nodes[node].radius;
    };
    std::vector<std::uint32_t> roots{0};
    while (roots.size() < kMostLightClusters) {
        const auto widest = std::ranges::max_element(roots, {}, spread);
        if (nodes[*widest].is_leaf != 0) break;
        const std::uint32_t node = *widest;
        *widest = node + 1;
        roots.push_back(nodes[node].next);
    }
    std::ranges::sort(roots);
    return roots;
}

/// Numbers the clusters along the nodes, whose order is depth first.
void mark_clusters(HostScene& packed) {
    std::vector<LightNode>& nodes = packed.light_nodes;
    packed.light_clusters = cluster_roots(nodes);
    std::uint32_t cluster = 0;
    for (std::uint32_t node = 0; node < nodes.size(); ++node) {
        if (cluster < packed.light_clusters.size() && packed.light_clusters[cluster] == node)
            nodes[node].cluster = cluster++;
        if (nodes[node].is_leaf != 0) packed.light_places[nodes[node].next].cluster = cluster - 1;
    }
}

}  // namespace

void pack_light_tree(HostScene& packed) {
    if (packed.lights.size() <= kFewLights) return;
    std::vector<LightItem> items;
    items.reserve(packed.lights.size());
    double total = 0.0;
    for (std::uint32_t light = 0; light < packed.lights.size(); ++light) {
        items.push_back(item_of(packed, light));
        total += items.back().bounds.power;
    }
    const double share =
        1.0 - static_cast<double>(packed.far_probability) - static_cast<double>(packed.delta_probability);
    for (LightItem& item : items) {
        item.bounds.power /= total;
        packed.light_places.push_back({.pdf_area = static_cast<float>(share / item.area)});
    }
    TreeBuilder(std::move(items), packed).build();
    mark_clusters(packed);
}

}  // namespace pl
