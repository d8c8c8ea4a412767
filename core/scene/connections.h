// Connected components of numbered things.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace pl {

/// Union-find with path halving.
class Connections {
public:
    explicit Connections(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    /// The number that stands for the component.
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t i, std::uint32_t j) { parent_[root(i)] = root(j); }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace pl
