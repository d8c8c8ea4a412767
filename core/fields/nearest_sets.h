// Which volumes can be the nearest of some point of a flat region, for points and distances as kernels round them.
#pragma once

#include <vector>

#include "core/fields/polygon.h"
#include "core/kernel/guiding/volume_lookup.h"

namespace pl {

/// Points origin + x * x_axis + y * y_axis + z * normal with (x, y) in the polygon and |z| <= thickness, in double.
/// The axes are orthonormal.
struct FlatRegion {
    Vec3d origin;
    Vec3d x_axis, y_axis, normal;
    Polygon polygon;
    double thickness = 0.0;
};

/// Coordinates up to this magnitude give squared distances in the range of float.
inline constexpr float kMaxCoordinate = 1e18f;

/// Finds sets of volumes. One per thread, because it keeps its memory.
class NearestSets {
public:
    enum class Answer {
        None,     ///< no volume has a normal that agrees
        Few,      ///< those in nodes()
        TooMany,  ///< not worth a list
        GivenUp,  ///< it takes too long to find even one
    };
    /// Longest set that is listed.
    static constexpr std::size_t kMostListed = 24;

    explicit NearestSets(KdTreeView tree) : tree_(tree) {}

    /// All volumes that a search from any point of the region, with this normal, may answer. The polygon must not be
    /// empty. Sets are exact up to a margin of a few roundoffs of the distances.
    Answer find(const FlatRegion& region, Vec3f normal);

    /// Forgets what was found before, so that effort does not depend on it: at the start of each piece of work.
    void restart() { hint_ = 0; }
    /// Nodes that one search may look at: where volumes are near whose normals do not agree, as
    /// on the outside of a closed mesh, the tree has to look at all of them.
    void set_effort(int nodes) { effort_ = nodes; }

    /// Tree nodes of the last set, by ascending volume.
    const std::vector<std::uint32_t>& nodes() const { return nodes_; }

private:
    /// A volume near the region, seen from the region's frame.
    struct Candidate {
        std::uint32_t node;
        std::uint32_t volume;
        float distance2;  ///< from the middle of the region
        double x, y, z;
        double length2;
    };
    struct Gather;
    struct Effort;

    Answer gather(const FlatRegion& region, Vec3f normal);
    void drop_duplicates();
    bool can_be_nearest(const Candidate& candidate, const FlatRegion& region) const;

    KdTreeView tree_;
    Nearest nearest_;
    std::uint32_t hint_ = 0;  ///< node that was nearest the last time
    int effort_ = 0;
    double margin_ = 0.0;  ///< by which squared distances may differ and still be confused by rounding
    std::vector<Candidate> candidates_;
    std::vector<std::uint32_t> nodes_;
};

}  // namespace pl
