// The order of the probes that fill a precomputed map.
#include "core/kernel/integrator/probe.h"

#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Probes measure each cell of each volume once, one of each 2 x 2 cells before the others") {
    for (const int side : {1, 2, 3, 5, 8, 16}) {
        INFO("side " << side);
        const std::vector<Vec3f> normals(7, Vec3f{0.0f, 1.0f, 0.0f});
        TableView field{};
        field.normals = {normals.data(), 7};
        field.cells.side = side;
        const std::uint32_t probes = probe_count(field);
        REQUIRE(probes == 7u * static_cast<std::uint32_t>(side * side));
        const std::uint32_t coarse = 7 * ProbeQuarter::of(side, 0).probes_of_volume();
        CHECK(coarse == 7u * static_cast<std::uint32_t>((side + 1) / 2 * ((side + 1) / 2)));
        std::vector<int> measured(probes, 0);
        for (std::uint32_t probe = 0; probe < probes; ++probe) {
            const TableEntry target = probe_target(field, probe);
            REQUIRE(target.volume >= 0);
            REQUIRE(target.volume < 7);
            REQUIRE(target.cell >= 0);
            REQUIRE(target.cell < side * side);
            ++measured[static_cast<std::size_t>(target.volume * side * side + target.cell)];
            const bool is_even = target.cell % side % 2 == 0 && target.cell / side % 2 == 0;
            CHECK(is_even == (probe < coarse));
        }
        CHECK(measured == std::vector<int>(probes, 1));
    }
}
