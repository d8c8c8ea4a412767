// Bound objects that call an object of Python, which may refer to them.
#pragma once

#include <atomic>
#include <string>

#include <nanobind/nanobind.h>

#include "core/base/error.h"

namespace pl {

/// While one lives, another thread, or the object that is called, may not use the caller.
class SoleUse {
public:
    /// `caller`: as the message names it.
    SoleUse(std::atomic<bool>& is_used, const char* caller) : is_used_(is_used) {
        if (is_used.exchange(true))
            throw Error(ErrorKind::Usage,
                        std::string("this ") + caller + " is in use by another thread, or asks what it calls");
    }
    ~SoleUse() { is_used_ = false; }
    SoleUse(const SoleUse&) = delete;
    SoleUse& operator=(const SoleUse&) = delete;

private:
    std::atomic<bool>& is_used_;
};

/// nanobind::type_slots of a type with called(), which may be null, and drop_called(): for the search for cycles.
template <class Caller>
struct CallerSlots {
    static int visit(PyObject* self, visitproc visit, void* arg) {
        Py_VISIT(Py_TYPE(self));
        if (nanobind::inst_ready(self)) Py_VISIT(nanobind::inst_ptr<Caller>(self)->called().ptr());
        return 0;
    }
    static int clear(PyObject* self) {
        if (nanobind::inst_ready(self)) nanobind::inst_ptr<Caller>(self)->drop_called();
        return 0;
    }

    static inline PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(visit)},
                                         {Py_tp_clear, reinterpret_cast<void*>(clear)},
                                         {0, nullptr}};
};

}  // namespace pl
