// Importance sampling from a radiance map that probes fill before rendering and that stays constant while rendering.
#pragma once

#include "core/kernel/methods/method_info.h"
#include "core/kernel/methods/targets/frozen.h"

namespace pl {

struct Precomputed {
    static constexpr MethodInfo kInfo{
        .name = "precomputed",
        .label = "Precomputed",
        .summary = "Directions guided by a radiance map that is computed first and then frozen.",
        .key = '2',
        .color = 0xffe69f00u,
        .uses_field = true,
        .precomputes = true};
};

}  // namespace pl
