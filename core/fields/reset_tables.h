// Parts of a learned field as they were before any training sample.
#pragma once

#include "core/fields/field_model.h"

namespace pl {

/// One volume as make_field() makes it: it has learned nothing. The leaf of an SD-tree at the volume forgets its directions with it.
/// `volume` is below volume_count().
void forget_volume(const FieldShape& shape, const HostVolumes& volumes, HostField& field, std::size_t volume);

}  // namespace pl
