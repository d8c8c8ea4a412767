// Parts of a volume grid that are built by different threads, and the class that joins them.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/fields/placement_storage.h"
#include "core/kernel/base/hash.h"

namespace pl {

/// The grids and cells of some sides, whose places number them from 0 for each of these pieces.
struct GridPieces {
    std::vector<std::uint32_t> sides;  ///< those whose places are of kind Grid or Cell
    std::vector<SideGrid> grids;
    std::vector<VolumeCell> cells;       ///< of grids
    std::vector<VolumeCell> side_cells;  ///< of whole sides
    std::vector<std::uint32_t> lists;
};

/// Joins pieces in order. Neighboring cells often have equal lists, and neighboring sides equal cells: each is stored
/// once.
class GridJoiner {
public:
    /// `places`: [side]; places of kind Grid or Cell have the numbers of their pieces.
    explicit GridJoiner(std::vector<VolumePlace> places) : known_(16, Hash{&grid_.lists}, Same{&grid_.lists}) {
        grid_.sides = std::move(places);
    }

    void add(const GridPieces& pieces) {
        const auto grids = static_cast<std::uint32_t>(grid_.grids.size());
        const auto cells = static_cast<std::uint32_t>(grid_.cells.size());
        for (const VolumeCell cell : pieces.cells) grid_.cells.push_back(joined(cell, pieces.lists));
        for (SideGrid grid : pieces.grids) {
            grid.first_cell += static_cast<std::int32_t>(cells);
            grid_.grids.push_back(grid);
        }
        for (const std::uint32_t side : pieces.sides) {
            VolumePlace& place = grid_.sides[side];
            if (place.kind() == VolumePlace::Kind::Grid)
                place = {place.kind(), place.number() + grids};
            else
                place = {place.kind(), side_cell(joined(pieces.side_cells[place.number()], pieces.lists))};
        }
    }

    HostVolumeGrid take() {
        known_.clear();
        side_cells_.clear();
        return std::move(grid_);
    }

private:
    using Lists = std::vector<std::uint32_t>;
    struct Hash {
        const Lists* lists;
        std::size_t operator()(std::uint32_t first) const {
            std::uint32_t hash = 0;
            for (std::uint32_t i = first;; ++i) {
                hash = hash_word(hash, (*lists)[i]);
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

    /// Appends the list, and removes it again if an equal one is stored already.
    VolumeCell joined(VolumeCell cell, const Lists& lists) {
        if (!cell.has_list()) return cell;
        const std::size_t first = grid_.lists.size();
        std::uint32_t i = cell.first_of_list();
        do grid_.lists.push_back(lists[i]);
        while ((lists[i++] & kLastOfList) == 0);
        const auto [known, is_new] = known_.insert(static_cast<std::uint32_t>(first));
        if (!is_new) grid_.lists.resize(first);
        return VolumeCell::list(*known);
    }

    std::uint32_t side_cell(VolumeCell cell) {
        const auto [known, is_new] =
            side_cells_.try_emplace(cell.word(), static_cast<std::uint32_t>(grid_.cells.size()));
        if (is_new) grid_.cells.push_back(cell);
        return known->second;
    }

    HostVolumeGrid grid_;
    std::unordered_set<std::uint32_t, Hash, Same> known_;
    std::unordered_map<std::uint64_t, std::uint32_t> side_cells_;
};

}  // namespace pl
