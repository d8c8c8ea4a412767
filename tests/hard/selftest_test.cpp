// `pathlight selftest` as a shell sees it.
#include <nlohmann/json.hpp>

#include "tests/support/catch.hpp"
#include "tests/support/margin.h"
#include "tests/support/program/outcome.h"

using namespace pl::test;
using nlohmann::json;

TEST_CASE("The self test passes on the CPU and tells every margin", "[hard]") {
    const ProgramResult result = run_program({"selftest", "--backend", "cpu", "--json"});
    CAPTURE(result.err);
    CHECK(result.code == 0);
    std::size_t checks = 0;
    for (const std::string& line : lines_of(result.out)) {
        const json event = json::parse(line);
        if (event.at("event") == "selfcheck") {
            CAPTURE(event.at("name"));
            CHECK(event.at("passed") == true);
            CHECK(event.at("backend") == "cpu");
            CHECK(within(event.at("used_share").get<double>(), 1.0));
            ++checks;
        } else {
            CHECK(event.at("event") == "selftest");
            CHECK(event.at("checks") == checks);
            CHECK(event.at("failed") == 0);
            CHECK(event.at("seconds").get<double>() >= 0.0);
        }
    }
    CHECK(checks > 20);
}

TEST_CASE("The self test takes no scene, and no back end that does not exist", "[hard]") {
    check_refused(2, {"selftest", "cornell"}, "unexpected argument 'cornell'");
    check_refused(2, {"selftest", "--backend", "gpu"}, "--backend: expected auto, cpu or cuda");
}
