#!/usr/bin/env bash
# check_names.sh ROOT: do all test names survive CMake lists? A bracket, semicolon or backslash would glue a name to
# the names that follow, and those tests would silently not run. Prints each that does not, exits 1 if any.
set -u
cd "$1" || exit 2
! grep -rnE '^(TEST_CASE|SCENARIO)\("[^"]*[][;\\]' --include='*.cpp' tests
