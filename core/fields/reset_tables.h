// Parts of a learned field as they were before any training sample.
#pragma once

#include "core/fields/field_model.h"

namespace pl {

/// One volume as make_field() makes it: it has learned nothing. `volume` is below volume_count().
void forget_volume(const FieldShape& shape, HostField& field, std::size_t volume);

}  // namespace pl
