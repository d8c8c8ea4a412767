#include "ui/worker/turns.h"

#include <cmath>
#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Turns: short passes go A, B, B, A in turns of equal time") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::vector<std::size_t> order;
    for (int pass = 0; pass < 400; ++pass) {
        const std::size_t side = turns.next(charged);
        if (order.empty() || order.back() != side) order.push_back(side);
        charged[side] += 0.01;
        CHECK(std::fabs(charged[0] - charged[1]) <= 0.5 + 0.011);
    }
    // Neighboring turns of one side look like one.
    CHECK((std::vector<std::size_t>(order.begin(), order.begin() + 6) == std::vector<std::size_t>{0, 1, 0, 1, 0, 1}));
    CHECK_FALSE(turns.catching_up());
}

TEST_CASE("Turns: passes longer than a turn are paid for with later turns") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::array<int, 2> passes{};
    for (int pass = 0; pass < 1000; ++pass) {
        const std::size_t side = turns.next(charged);
        charged[side] += side == 0 ? 1.7 : 0.03;
        ++passes[side];
        REQUIRE(std::fabs(charged[0] - charged[1]) <= 0.5 + 1.71);
    }
    CHECK(passes[0] > 10);
    CHECK_THAT(static_cast<double>(passes[1]) / passes[0], WithinRel(1.7 / 0.03, 0.2));
}

TEST_CASE("Turns: the side that is behind catches up first, also when one starts over") {
    Turns turns(0.25);
    std::array<double, 2> charged{5.0, 0.0};
    while (charged[1] < 5.0) {
        REQUIRE(turns.next(charged) == 1);
        CHECK(turns.catching_up());
        charged[1] += 0.1;
    }
    (void)turns.next(charged);
    CHECK_FALSE(turns.catching_up());
    charged = {6.0, 0.02};  // its picture was emptied
    CHECK(turns.next(charged) == 1);
    CHECK(turns.catching_up());
    charged = {0.0, 0.0};
    CHECK(turns.next(charged) == 0);
    CHECK_FALSE(turns.catching_up());
}
