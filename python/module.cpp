// `import pathlight`: the extension module. Its errors are exceptions of Python with the program's messages.
#include <exception>

#include "app/version.h"
#include "core/base/error.h"
#include "python/bindings.h"

namespace pl {
namespace {

namespace nb = nanobind;

/// The package defines them.
const char* exception_name(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::Runtime: break;
    case ErrorKind::Usage: return "UsageError";
    case ErrorKind::Input: return "InputError";
    case ErrorKind::Unavailable: return "UnavailableError";
    case ErrorKind::Threshold: return "ThresholdError";
    }
    return "WorkError";
}

void translate_errors() {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const Error& error) {
            const nb::object type = nb::module_::import_("pathlight").attr(exception_name(error.kind()));
            PyErr_SetString(type.ptr(), error.what());
        }
    });
}

}  // namespace
}  // namespace pl

NB_MODULE(_pathlight, module) {
    module.doc() = "Pathlight, a path tracer that learns where light comes from.";
    module.attr("version") = PL_VERSION;
    pl::translate_errors();
    pl::bind_scene(module);
    pl::bind_learner(module);
    pl::bind_field(module);
    pl::bind_session(module);
    pl::bind_tracer(module);
    pl::bind_program(module);
}
