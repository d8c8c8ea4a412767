// `import pathlight`: the extension module. Its errors are exceptions of Python with the program's messages.
#include <array>
#include <exception>

#include "app/version.h"
#include "core/base/error.h"
#include "python/bindings.h"

namespace pl {
namespace {

namespace nb = nanobind;

struct BoundError {
    ErrorKind kind;
    const char* name;
    PyObject* builtin;  ///< also derived from
    const char* doc;
    PyObject* type = nullptr;
};

std::array<BoundError, 5>& bound_errors() {
    static std::array errors{
        BoundError{ErrorKind::Runtime, "WorkError", PyExc_RuntimeError,
                   "Failure during the work: a full disk, a lost device."},
        BoundError{ErrorKind::Usage, "UsageError", PyExc_ValueError, "An option or argument is wrong."},
        BoundError{ErrorKind::Input, "InputError", PyExc_ValueError,
                   "A file, an array or the answer of a learner is missing or invalid."},
        BoundError{ErrorKind::Unavailable, "UnavailableError", PyExc_RuntimeError,
                   "A back end or device is missing."},
        BoundError{ErrorKind::Threshold, "ThresholdError", PyExc_RuntimeError,
                   "Another limit was reached before the target error."}};
    return errors;
}

void bind_errors(nb::module_& module) {
    PyObject* const base = PyErr_NewExceptionWithDoc(
        "pathlight.Error", "Every error of pathlight; str() is the program's message.", nullptr, nullptr);
    module.attr("Error") = nb::steal(base);
    for (BoundError& error : bound_errors()) {
        const nb::object bases = nb::make_tuple(nb::handle(base), nb::handle(error.builtin));
        const std::string name = std::string("pathlight.") + error.name;
        error.type = PyErr_NewExceptionWithDoc(name.c_str(), error.doc, bases.ptr(), nullptr);
        module.attr(error.name) = nb::steal(error.type);
    }
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const Error& error) {
            for (const BoundError& bound : bound_errors())
                if (bound.kind == error.kind()) PyErr_SetString(bound.type, error.what());
        }
    });
}

}  // namespace
}  // namespace pl

NB_MODULE(_pathlight, module) {
    module.doc() = "Pathlight, a path tracer that learns where light comes from.";
    module.attr("__version__") = PL_VERSION;
    pl::bind_errors(module);
    pl::bind_scene(module);
    pl::bind_learner(module);
    pl::bind_field(module);
    pl::bind_session(module);
    pl::bind_tracer(module);
    pl::bind_program(module);
}
