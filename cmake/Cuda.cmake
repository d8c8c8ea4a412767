# This version has no CUDA back end. PL_CUDA is read all the same, so that presets and scripts stay valid.
if(NOT PL_CUDA MATCHES "^(AUTO|OFF)$")
    message(FATAL_ERROR "PL_CUDA: expected AUTO or OFF, got '${PL_CUDA}'")
endif()
