// A field after it was saved and loaded.
#pragma once

#include "core/io/field_file.h"
#include "tests/support/files/temporary_folder.h"

namespace pl::test {

inline LearnedField through_file(const LearnedField& field) {
    const TemporaryFolder folder;
    write_field(folder.path() / "field", field);
    return read_field(folder.path() / "field");
}

}  // namespace pl::test
