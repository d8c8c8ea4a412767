# Run at every build: writes OUTPUT anew only if the commit has changed, so that nothing else is compiled for it.
# cmake -DSOURCE_DIR=.. -DOUTPUT=.. -P CommitId.cmake
set(ENV{GIT_OPTIONAL_LOCKS} 0) # looking must not write to the repository
set(commit "")
execute_process(
    COMMAND git -C "${SOURCE_DIR}" describe --always --dirty --abbrev=12
    OUTPUT_VARIABLE commit
    OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
if(NOT commit MATCHES "^[A-Za-z0-9._/+-]+$")
    set(commit unknown)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#include "app/build_info.h"

std::string_view pl::commit_id() { return "@commit@"; }
]])
