// A refusal of the program: exit code, message, no result.
#pragma once

#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {

/// The program prints an error that contains `told` on standard error, no result, and exits with the code.
inline void check_refused(int code, const Arguments& arguments, const std::string& told) {
    const ProgramResult result = run_program(arguments);
    CAPTURE(arguments, result.err);
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, contains("error: ") && contains(told));
}

}  // namespace pl::test
