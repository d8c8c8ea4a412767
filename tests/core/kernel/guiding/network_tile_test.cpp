// The network for several vertices at once, by threads that stand for the lanes of a warp: the bits of one vertex at a time.
#include "core/kernel/guiding/network_tile.h"

#include <barrier>
#include <limits>
#include <thread>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/random_values.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Memory of a tile as a device would leave it: of no use before it is written.
template <class Tile>
struct alignas(16) TileMemory {
    float values[Tile::kMemory];

    TileMemory() { std::fill(std::begin(values), std::end(values), std::numeric_limits<float>::quiet_NaN()); }
};

/// All but the last vertex, whose inputs stay unset if there are others.
template <std::uint32_t kLanes, std::uint32_t kVertices>
void check_tile() {
    INFO(kLanes << " lanes, " << kVertices << " vertices");
    constexpr std::uint32_t kSet = kVertices > 1 ? kVertices - 1 : 1;
    using Tile = NetworkTile<kLanes, kVertices>;
    TileMemory<Tile> memory;
    const std::vector<float> weights = random_values(kNetworkWeights, -0.3f, 0.3f, 1);
    std::vector<float> inputs = random_values(kSet * kInputs, -1.0f, 1.0f, 2);
    std::vector<float> outputs(kSet * kVertexOutputs);
    std::barrier<> lanes(kLanes);
    std::vector<std::jthread> threads;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane)
        threads.emplace_back([&, lane] {
            const Tile tile(memory.values, lane);
            if (lane < kSet) tile.set_inputs(lane, inputs.data() + lane * kInputs);
            tile.evaluate(weights.data(), [&] { lanes.arrive_and_wait(); });
            for (std::uint32_t i = 0; lane < kSet && i < kVertexOutputs; ++i)
                outputs[lane * kVertexOutputs + i] = tile.output(lane, i);
        });
    threads.clear();
    for (std::uint32_t vertex = 0; vertex < kSet; ++vertex) {
        INFO("vertex " << vertex);
        float expected[kVertexColumns];
        inputs[vertex * kInputs + kConstantInput] = 1.0f;
        evaluate_vertex<float>(weights.data(), inputs.data() + vertex * kInputs, expected);
        for (std::uint32_t i = 0; i < kVertexOutputs; ++i) CHECK(outputs[vertex * kVertexOutputs + i] == expected[i]);
    }
}

}  // namespace

TEST_CASE("The network of several vertices by the lanes of a warp has the bits of one vertex at a time") {
    check_tile<1, 1>();
    check_tile<32, 4>();
    check_tile<32, 8>();
    check_tile<32, 16>();
}
