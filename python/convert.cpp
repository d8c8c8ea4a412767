#include "python/convert.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "app/events.h"
#include "core/base/error.h"

namespace pl {

std::vector<float> floats_of(const char* what, const nb::object& numbers, const nb::tuple& shape) {
    const nb::object array = nb::module_::import_("numpy").attr("ascontiguousarray")(numbers, "float32");
    const nb::object got = array.attr("shape");
    if (!got.equal(shape))
        throw Error(ErrorKind::Input, fmt::format("{}: expected an array of shape {}, got {}", what,
                                                  nb::str(shape).c_str(), nb::str(got).c_str()));
    const auto values = nb::cast<nb::ndarray<const float, nb::c_contig, nb::device::cpu>>(array);
    return {values.data(), values.data() + values.size()};
}

nb::object from_json(const Json& json) { return nb::module_::import_("json").attr("loads")(json_line(json)); }

std::string json_text(const nb::handle& value) {
    return nb::cast<std::string>(nb::module_::import_("json").attr("dumps")(value));
}

}  // namespace pl
