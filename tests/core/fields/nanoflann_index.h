// Another library's search over the sites of volumes: an independent oracle for distances.
#pragma once

#include <vector>

#include <nanoflann.hpp>

#include "core/kernel/scene/surface_point.h"

namespace pl::test {

using Sites = std::vector<SurfacePoint>;

/// nanoflann over the same points.
class NanoflannIndex {
public:
    explicit NanoflannIndex(const Sites& sites) : cloud_{sites}, tree_(3, cloud_, {10}) { tree_.buildIndex(); }

    float nearest_distance2(Vec3f position) const {
        std::size_t index = 0;
        float distance2 = 0.0f;
        const float query[3] = {position.x, position.y, position.z};
        nanoflann::KNNResultSet<float> result(1);
        result.init(&index, &distance2);
        tree_.findNeighbors(result, query, {});
        return distance2;
    }

private:
    struct Cloud {
        const Sites& sites;
        std::size_t kdtree_get_point_count() const { return sites.size(); }
        float kdtree_get_pt(std::size_t i, std::size_t axis) const {
            return sites[i].position[static_cast<int>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud>;

    Cloud cloud_;
    nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3> tree_;
};

}  // namespace pl::test
