#include "core/io/mitsuba/medium.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/kernel/base/math.h"

namespace pl {

glm::vec3 mitsuba_absorption(const MitsubaObject& medium) {
    const glm::vec3 none(0.0f);
    const bool is_even = medium.type() == "homogeneous" && !medium.text("material");
    glm::vec3 absorbed = medium.color("sigma_a").value_or(none);
    glm::vec3 scattered = medium.color("sigma_s").value_or(none);
    if (!medium.property("sigma_a")) {
        const glm::vec3 all = medium.color("sigma_t").value_or(glm::vec3(1.0f));
        scattered = all * medium.color("albedo").value_or(glm::vec3(0.75f));
        absorbed = all - scattered;
    }
    if (!is_even || scattered != none) {
        medium.leave_out("media that scatter light, and those that vary, are left out");
        return none;
    }
    absorbed *= medium.number("scale").value_or(1.0f);
    if (!is_finite(absorbed) || !glm::all(glm::greaterThanEqual(absorbed, none)))
        medium.fail(
            fmt::format("expected an absorption of at least 0, got {} {} {}", absorbed.x, absorbed.y, absorbed.z));
    return absorbed;
}

}  // namespace pl
