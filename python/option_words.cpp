#include "python/option_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanobind/stl/string.h>

#include "app/option_table.h"
#include "python/convert.h"

namespace pl {
namespace {

bool is_instance(const nb::handle& value, PyTypeObject& type) { return PyObject_TypeCheck(value.ptr(), &type) != 0; }

/// A value as it is typed on the command line: True: on; (1, 2): 1,2; {'passes': 4}: passes=4.
std::string option_text(const nb::handle& value, const char* separator = ",") {
    if (nb::hasattr(value, "tolist")) return option_text(value.attr("tolist")(), separator);  // of NumPy
    if (is_instance(value, PyBool_Type)) return value.is(Py_True) ? "on" : "off";
    if (!is_instance(value, PyList_Type) && !is_instance(value, PyTuple_Type) && !is_instance(value, PyDict_Type))
        return nb::str(value).c_str();
    std::vector<std::string> items;
    const bool is_dict = is_instance(value, PyDict_Type);
    for (const nb::handle item : value)
        items.push_back(is_dict ? fmt::format("{}={}", option_text(item), option_text(value[item]))
                                : option_text(item));
    return fmt::format("{}", fmt::join(items, separator));
}

/// Such as --why; it has no value.
bool is_switch(const std::string& name) {
    return std::ranges::any_of(option_table(),
                               [&](const OptionSpec& spec) { return spec.value.empty() && spec.name == name; });
}

}  // namespace

std::vector<std::string> option_words(const nb::kwargs& options) {
    std::vector<std::string> words;
    for (const auto& [key, value] : options) {
        if (value.is_none()) continue;
        auto name = nb::cast<std::string>(key);
        std::ranges::replace(name, '_', '-');
        const bool is_size = name == "size" || name == "window";
        const bool is_camera = name == "camera" && is_instance(value, PyDict_Type);
        const std::string text = is_camera ? json_text(value) : option_text(value, is_size ? "x" : ",");
        words.push_back(value.is(Py_True) && is_switch(name) ? "--" + name : "--" + name + "=" + text);
    }
    return words;
}

}  // namespace pl
