// One path of a past pass, or of the next one, traced again with a record of all its vertices.
#pragma once

#include "core/diagnose/path_record.h"
#include "core/session/pass_replay.h"

namespace pl::diagnose {

/// View of the field of these passes; empty for methods without one. Valid as long as `passes`.
AnyFieldView field_of(PassReplay& passes);

/// Runs the kernel's own steps on the CPU, in any thread. `field` is field_of(passes), `pass` the number of the pass within the
/// picture. The record has the bits of the picture's path if the field is that which the pass sampled from: always if the method
/// does not learn, else for pass PassReplay::samples after Session::advance_to_path().
PathRecord record_path(const PassReplay& passes, const AnyFieldView& field, std::uint32_t pixel, std::uint32_t pass);

}  // namespace pl::diagnose
