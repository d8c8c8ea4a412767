// Between values of the program and of Python: arrays of NumPy, and JSON as plain dictionaries.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "core/io/json_file.h"

namespace pl {

namespace nb = nanobind;

template <class T>
using NumpyArray = nb::ndarray<nb::numpy, T, nb::c_contig>;

/// An array that owns `values`, whose elements are one Scalar or several, such as Vec3f. The caller holds the GIL.
template <class Scalar, class T>
NumpyArray<Scalar> own_array(std::vector<T> values, std::initializer_list<std::size_t> shape) {
    static_assert(sizeof(T) % sizeof(Scalar) == 0);
    auto* const kept = new std::vector<T>(std::move(values));
    const nb::capsule owner(kept, [](void* array) noexcept { delete static_cast<std::vector<T>*>(array); });
    return {reinterpret_cast<Scalar*>(kept->data()), shape, owner};
}
template <class Scalar, class Range>
NumpyArray<Scalar> copy_array(const Range& values, std::initializer_list<std::size_t> shape) {
    return own_array<Scalar>(std::vector<typename Range::value_type>(values.begin(), values.end()), shape);
}

/// Points or directions: float32 or what converts to it. (n, 3)
using Vectors = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
/// (n, 2)
using Pairs = nb::ndarray<const float, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

inline Vec3f vector_at(const Vectors& vectors, std::size_t i) {
    return {vectors(i, 0), vectors(i, 1), vectors(i, 2)};
}

/// A method that a module of the package has, written in Python.
inline auto python_method(const char* module, const char* function) {
    return [=](const nb::handle& self, const nb::args& args, const nb::kwargs& named) {
        return nb::module_::import_((std::string("pathlight.") + module).c_str())
            .attr(function)(self, *args, **named);
    };
}

/// What NumPy makes an array of. Throws Error(Input) for another shape; `what` names the numbers.
std::vector<float> floats_of(const char* what, const nb::object& numbers, const nb::tuple& shape);

/// None, bool, numbers, str, list and dict.
nb::object from_json(const Json& json);
/// JSON text of such a value.
std::string json_text(const nb::handle& value);

}  // namespace pl
