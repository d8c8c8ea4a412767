// Parts of a volume grid, built by different threads, and what joins them.
#pragma once

#include <unordered_set>
#include <utility>
#include <vector>

#include "core/fields/field_storage.h"

namespace pl {

/// Places of some sides; grids, cells and lists are numbered from 0.
struct GridPieces {
    std::vector<VolumePlace> sides;
    std::vector<SideGrid> grids;
    std::vector<VolumePlace> cells;
    std::vector<std::uint32_t> lists;
};

/// Joins pieces in order. Neighbors often have the same list: it is kept once.
class GridJoiner {
public:
    GridJoiner() : known_(16, Hash{&grid_.lists}, Same{&grid_.lists}) {}

    void add(const GridPieces& pieces) {
        const auto grids = static_cast<std::uint32_t>(grid_.grids.size());
        const auto cells = static_cast<std::uint32_t>(grid_.cells.size());
        for (const VolumePlace place : pieces.sides)
            grid_.sides.push_back(place.kind() == VolumePlace::Kind::Grid
                                      ? VolumePlace{VolumePlace::Kind::Grid, place.number() + grids}
                                      : joined(place, pieces.lists));
        for (SideGrid grid : pieces.grids) {
            grid.first_cell += cells;
            grid_.grids.push_back(grid);
        }
        for (const VolumePlace place : pieces.cells) grid_.cells.push_back(joined(place, pieces.lists));
    }

    HostVolumeGrid take() {
        known_.clear();
        return std::move(grid_);
    }

private:
    using Lists = std::vector<std::uint32_t>;
    struct Hash {
        const Lists* lists;
        std::size_t operator()(std::uint32_t first) const {
            std::uint64_t hash = 0;
            for (std::uint32_t i = first;; ++i) {
                hash = (hash ^ (*lists)[i]) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 32;
                if (((*lists)[i] & kLastOfList) != 0) return hash;
            }
        }
    };
    struct Same {
        const Lists* lists;
        bool operator()(std::uint32_t a, std::uint32_t b) const {
            for (;; ++a, ++b) {
                if ((*lists)[a] != (*lists)[b]) return false;
                if (((*lists)[a] & kLastOfList) != 0) return true;
            }
        }
    };

    /// The list is written behind the others, and taken back if it was there already.
    VolumePlace joined(VolumePlace place, const Lists& lists) {
        if (place.kind() != VolumePlace::Kind::List) return place;
        const std::size_t first = grid_.lists.size();
        std::uint32_t i = place.number();
        do grid_.lists.push_back(lists[i]);
        while ((lists[i++] & kLastOfList) == 0);
        const auto [known, is_new] = known_.insert(static_cast<std::uint32_t>(first));
        if (!is_new) grid_.lists.resize(first);
        return {VolumePlace::Kind::List, *known};
    }

    HostVolumeGrid grid_;
    std::unordered_set<std::uint32_t, Hash, Same> known_;
};

}  // namespace pl
