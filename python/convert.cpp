#include "python/convert.h"

#include <nanobind/stl/string.h>

#include "app/events.h"

namespace pl {

nb::object from_json(const Json& json) { return nb::module_::import_("json").attr("loads")(json_line(json)); }

std::string json_text(const nb::handle& value) {
    return nb::cast<std::string>(nb::module_::import_("json").attr("dumps")(value));
}

}  // namespace pl
