#include "core/scene/pack_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/scene/connections.h"
#include "core/scene/position_numbers.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

constexpr double kPi64 = 3.14159265358979323846;
constexpr int kBins = 12;
constexpr std::uint32_t kNoLamp = 0xffffffffu;
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
struct GatheredBounds {
    Vec3d low{std::numeric_limits<double>::infinity()};
    Vec3d high{-std::numeric_limits<double>::infinity()};
    Cone cone;
    double power = 0.0;

    void add(const GatheredBounds& other) {
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
    GatheredBounds bounds{};
    std::uint32_t light = 0;
    double area = 0.0;
};

/// Lights that share corners: one lamp.
struct Lamp {
    GatheredBounds bounds{};
    std::vector<LightItem> lights{};
};

/// A total order of lights, and of lamps.
std::uint32_t number_of(const LightItem& item) { return item.light; }
std::uint32_t number_of(const Lamp& lamp) { return lamp.lights.front().light; }

/// Lights or lamps in bins by their centers along one axis, split behind one of the bins.
struct LightSplit {
    int axis = 0;
    double low = 0.0;
    double scale = 0.0;
    int bin = -1;  ///< last bin of the first child; -1: none found
    double cost = std::numeric_limits<double>::infinity();

    /// Monotone in the center, so that equal centers share a bin.
    int bin_of(const GatheredBounds& bounds) const {
        return std::min(static_cast<int>((bounds.center()[axis] - low) * scale), kBins - 1);
    }
};

/// The upper nodes hold whole lamps: a dome around all others would hide them in every node that holds parts of it and of them, since
/// the importance of a node knows its size and its power alone.
class TreeBuilder {
public:
    explicit TreeBuilder(HostScene& packed) : packed_(packed) {}

    void build(std::vector<Lamp> lamps) { add_node(std::span(lamps), 0, 0); }

private:
    template <class Item>
    void add_node(std::span<Item> items, int level, std::uint64_t trail) {
        if (items.size() == 1) return add_leaf(items.front(), level, trail);
        GatheredBounds bounds;
        for (const Item& item : items) bounds.add(item.bounds);
        const std::size_t node = packed_.light_nodes.size();
        packed_.light_nodes.push_back(packed_node(bounds));
        const std::size_t middle = partition(items, level, bounds);
        add_node(items.first(middle), level + 1, trail);
        packed_.light_nodes[node].next = static_cast<std::uint32_t>(packed_.light_nodes.size());
        add_node(items.subspan(middle), level + 1, trail | std::uint64_t{1} << level);
    }
    void add_leaf(Lamp& lamp, int level, std::uint64_t trail) { add_node(std::span(lamp.lights), level, trail); }
    void add_leaf(const LightItem& item, int, std::uint64_t trail) {
        LightNode leaf = packed_node(item.bounds);
        leaf.is_leaf = 1;
        leaf.next = item.light;
        packed_.light_nodes.push_back(leaf);
        packed_.light_places[item.light].trail = trail;
    }

    /// Partitions lights or lamps between two children, neither of them empty; returns the begin of the second.
    template <class Item>
    static std::size_t partition(std::span<Item> items, int level, const GatheredBounds& bounds) {
        const LightSplit split = level < kMostUnevenLevels ? best_split<Item>(items) : LightSplit{};
        if (split.bin >= 0)
            return static_cast<std::size_t>(
                std::partition(items.begin(), items.end(),
                               [&](const Item& item) { return split.bin_of(item.bounds) <= split.bin; }) -
                items.begin());
        const Vec3d size = bounds.high - bounds.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t middle = items.size() / 2;
        std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(),
                         [axis](const Item& a, const Item& b) {
                             const double x = a.bounds.center()[axis];
                             const double y = b.bounds.center()[axis];
                             return x != y ? x < y : number_of(a) < number_of(b);
                         });
        return middle;
    }

    template <class Item>
    static LightSplit best_split(std::span<const Item> items) {
        Vec3d low{std::numeric_limits<double>::infinity()};
        Vec3d high{-std::numeric_limits<double>::infinity()};
        for (const Item& item : items) {
            low = glm::min(low, item.bounds.center());
            high = glm::max(high, item.bounds.center());
        }
        LightSplit best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(high[axis] > low[axis])) continue;
            best_on_axis({.axis = axis, .low = low[axis], .scale = kBins / (high[axis] - low[axis])}, items, best);
        }
        return best;
    }

    template <class Item>
    static void best_on_axis(LightSplit split, std::span<const Item> items, LightSplit& best) {
        std::array<GatheredBounds, kBins> bins;
        for (const Item& item : items) bins[static_cast<std::size_t>(split.bin_of(item.bounds))].add(item.bounds);
        std::array<double, kBins> above{};  // cost of all bins above
        GatheredBounds sum;
        for (std::size_t i = kBins - 1; i > 0; --i) {
            sum.add(bins[i]);
            above[i - 1] = sum.cost();
        }
        sum = {};
        for (split.bin = 0; split.bin + 1 < kBins; ++split.bin) {
            sum.add(bins[static_cast<std::size_t>(split.bin)]);
            split.cost = sum.cost() + above[static_cast<std::size_t>(split.bin)];
            // The outermost bins are never empty, so neither child is.
            if (split.cost < best.cost) best = split;
        }
    }

    static LightNode packed_node(const GatheredBounds& bounds) {
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

    HostScene& packed_;
};

/// Lamps of connected lights, in the order of their first lights.
std::vector<Lamp> lamps_of(const HostScene& packed, const std::vector<LightItem>& items) {
    PositionNumbers positions(3 * items.size());
    std::vector<std::uint32_t> corners;  // [light][corner], number of its position
    corners.reserve(3 * items.size());
    for (const LightItem& item : items) {
        const Triangle& t = packed.triangles[packed.lights[item.light].primitive];
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) corners.push_back(positions.number_of(packed.positions[v]));
    }
    Connections connections(positions.count());
    for (std::size_t i = 0; i < corners.size(); ++i) connections.join(corners[i], corners[i - i % 3]);
    std::vector<Lamp> lamps;
    std::vector<std::uint32_t> lamp_of(positions.count(), kNoLamp);
    for (std::size_t i = 0; i < items.size(); ++i) {
        std::uint32_t& lamp = lamp_of[connections.root(corners[3 * i])];
        if (lamp == kNoLamp) {
            lamp = static_cast<std::uint32_t>(lamps.size());
            lamps.emplace_back();
        }
        lamps[lamp].lights.push_back(items[i]);
        lamps[lamp].bounds.add(items[i].bounds);
    }
    return lamps;
}

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
    packed.light_nodes.reserve(2 * items.size() - 1);
    TreeBuilder(packed).build(lamps_of(packed, items));
    mark_clusters(packed);
}

}  // namespace pl
