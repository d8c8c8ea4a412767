// One libFuzzer program per entry: PL_FUZZ_ENTRY is its name.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/entries.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const pl::test::FuzzEntry* const entry = pl::test::find_fuzz_entry(PL_FUZZ_ENTRY);
    entry->run({reinterpret_cast<const char*>(data), size});
    return 0;
}
