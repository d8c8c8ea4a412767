# Looks for MPI. Sets PL_MPI_BUILT, or PL_MPI_MISSING to the reason; with PL_MPI=ON a missing one is an error.
set(PL_MPI_BUILT OFF)
set(PL_MPI_MISSING "")

if(NOT PL_MPI MATCHES "^(AUTO|ON|OFF)$")
    message(FATAL_ERROR "PL_MPI: expected AUTO, ON or OFF, got '${PL_MPI}'")
endif()

if(PL_MPI STREQUAL "OFF")
    set(PL_MPI_MISSING "configured with PL_MPI=OFF")
elseif(PL_SANITIZE)
    # Open MPI's own leaks and races would be reported; tests run ranks as threads.
    set(PL_MPI_MISSING "a build with sanitizers")
else()
    set(MPI_CXX_SKIP_MPICXX ON)
    find_package(MPI QUIET COMPONENTS CXX)
    if(MPI_CXX_FOUND)  # the target may exist without MPI
        set(PL_MPI_BUILT ON)
    elseif(PL_MPI STREQUAL "ON")
        message(FATAL_ERROR "PL_MPI=ON: no MPI was found\n./run --with mpi installs it, or: apt-get install libopenmpi-dev openmpi-bin")
    else()
        set(PL_MPI_MISSING "no MPI was found, ./run --with mpi installs it")
    endif()
endif()
