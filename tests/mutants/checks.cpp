// Short versions of the statistical tests, to be run on kernels with a seeded defect: each decides on the true
// kernel, and each must fail on the defects that tests/mutants/CMakeLists.txt gives to it.
//   checks NAME            succeeds if the check passes
//   checks NAME --caught   succeeds if the check fails by its own rule; undecided is not caught
#include <iostream>
#include <string_view>

#include "tests/mutants/field_checks.h"
#include "tests/mutants/light_checks.h"
#include "tests/mutants/ray_checks.h"
#include "tests/mutants/surface_checks.h"

namespace pl::test {
namespace {

struct Check {
    std::string_view name;
    Decision (*run)();
};

constexpr Check kChecks[] = {
    {"fresh-numbers", check_fresh_numbers},
    {"cube", check_cube},
    {"cube-next-event", check_cube_next_event},
    {"cube-guided", check_cube_guided},
    {"roulette", check_roulette},
    {"equilibrium", check_equilibrium},
    {"depth", check_depth},
    {"umbra", check_umbra},
    {"learned-cells", check_learned_cells},
    {"probed-cells", check_probed_cells},
    {"furnace-cells", check_furnace_cells},
    {"furnace-lights", check_furnace_lights},
    {"furnace-many-lights", check_furnace_many_lights},
    {"mixture-density", check_mixture_density},
    {"floor", check_floor},
    {"facets", check_facets},
    {"white-surfaces", check_white_surfaces},
    {"many-lights", check_many_lights},
    {"edges", check_edges},
    {"walk", check_walk},
    {"leaning", check_leaning},
    {"instances", check_instances},
};

}  // namespace
}  // namespace pl::test

int main(int argc, char** argv) {
    const std::string_view name = argc > 1 ? argv[1] : "";
    const bool want_caught = argc > 2 && std::string_view(argv[2]) == "--caught";
    for (const pl::test::Check& check : pl::test::kChecks) {
        if (check.name != name) continue;
        const pl::test::Decision decision = check.run();
        std::cout << check.name << ": " << decision << "\n";
        return decision.verdict == (want_caught ? pl::test::Verdict::Fail : pl::test::Verdict::Pass) ? 0 : 1;
    }
    std::cerr << "no check is called '" << name << "'\n";
    return 2;
}