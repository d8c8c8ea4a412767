// The message of the Error(Input) that a call must throw.
#pragma once

#include <string>

#include "core/base/error.h"
#include "tests/support/catch.hpp"

namespace pl::test {

/// Message of the Error of this kind; fails the test on any other outcome.
template <typename Call>
std::string error_message(ErrorKind kind, Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.kind() == kind);
        return error.what();
    }
    FAIL("expected an error");
    return {};
}

template <typename Call>
std::string input_error(Call&& call) {
    return error_message(ErrorKind::Input, call);
}

/// Whether the call succeeds; fails the test if it throws anything but an Error(Input) with a message.
template <typename Call>
bool loads_or_refuses(Call&& call) {
    try {
        call();
        return true;
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Input);
        CHECK_FALSE(std::string(error.what()).empty());
        return false;
    }
}

}  // namespace pl::test
