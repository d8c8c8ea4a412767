// The vertices of a block of paths in the lanes of their paths: all at Lambert reflectors.
#pragma once

#include "core/kernel/methods/method.h"
#include "cpu/base/path_groups.h"
#include "cpu/paths/vertex_rows.h"

namespace pl {

/// Vertex i is that of path i of the block, if it has reached one from which it may go on.
template <Method M>
class LaneBlock : public VertexRows {
public:
    using Vertex = typename M::Vertex;

    /// The block has `count` paths; none is at a vertex.
    void clear(std::uint32_t count) {
        count_ = count;
        reached_ = 0;
        continuing_ = 0;
    }
    /// One bit per path that is at a vertex, and per path that goes on from there.
    void set_reached(std::uint64_t bits) { reached_ = bits; }
    void set_continuing(std::uint64_t bits) { continuing_ = bits; }
    void set_vertex(std::uint32_t i, const Vertex& vertex) { vertices_[i] = vertex; }

    std::uint32_t group_count() const { return pl::group_count(count_); }
    const Vertex& vertex(std::uint32_t i) const { return vertices_[i]; }
    static constexpr bool is_layered(std::uint32_t) { return false; }
    void for_lambert(const auto& visit) const { for_bits(reached_, visit); }
    void for_continuing_lambert(const auto& visit) const { for_bits(continuing_, visit); }

private:
    std::uint32_t count_ = 0;
    std::uint64_t reached_ = 0;
    std::uint64_t continuing_ = 0;
    Vertex vertices_[kPathBlock];
};

}  // namespace pl
