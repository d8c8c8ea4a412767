// Arguments put together from parts.
#pragma once

#include "tests/support/program/run_program.h"

namespace pl::test {

inline Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

}  // namespace pl::test
