// A learned field as Python holds it.
#pragma once

#include "core/session/learned_field.h"

namespace pl {

/// A copy, which a session does not change.
struct BoundField {
    LearnedField learned;

    std::size_t volumes() const { return learned.volumes->normals.size(); }
    std::size_t cells() const { return static_cast<std::size_t>(learned.shape.cells.count()); }
    AnyFieldView view() { return field_view(learned.shape, *learned.volumes, learned.field); }
};

}  // namespace pl
