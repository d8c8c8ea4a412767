# Writes the current commit to the source file OUTPUT, which changes only if the commit has.
# cmake -DSOURCE_DIR=.. -DOUTPUT=.. -P CommitId.cmake
set(ENV{GIT_OPTIONAL_LOCKS} 0) # git describe must not write to the repository
set(commit "")
set(top "")
execute_process(
    COMMAND git -C "${SOURCE_DIR}" rev-parse --show-toplevel
    OUTPUT_VARIABLE top
    OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
file(REAL_PATH "${SOURCE_DIR}" source)
if(top STREQUAL source) # not a source archive inside of another repository
    execute_process(
        COMMAND git -C "${SOURCE_DIR}" describe --always --dirty --abbrev=12
        OUTPUT_VARIABLE commit
        OUTPUT_STRIP_TRAILING_WHITESPACE
        ERROR_QUIET)
endif()
if(NOT commit MATCHES "^[A-Za-z0-9._/+-]+$")
    set(commit unknown)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#include "app/version.h"

std::string_view pl::commit_id() { return "@commit@"; }
]])
