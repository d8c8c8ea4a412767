// What a run of the program has to come to: a result, or a refusal.
#pragma once

#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {

/// Runs a command that has to succeed.
inline ProgramResult run_well(const Arguments& arguments) {
    ProgramResult result = run_program(arguments);
    CAPTURE(arguments, result.err);
    REQUIRE(result.code == 0);
    return result;
}

/// The program prints an error that contains `told` on standard error, no result, and exits with the code.
inline void check_refused(int code, const Arguments& arguments, const std::string& told) {
    const ProgramResult result = run_program(arguments);
    CAPTURE(arguments, result.err);
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, contains("error: ") && contains(told));
}

}  // namespace pl::test
