// The targets of fuzzing: one entry per kind of input. Each takes any bytes; whatever it does besides reading them or refusing
// them with an Error(Input) is a defect. libFuzzer calls them in clang builds, a plain test over the corpora everywhere.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pl::test {

struct FuzzEntry {
    std::string_view name;  ///< of its corpus, too: tests/fuzz/corpus/NAME
    void (*run)(std::string_view bytes);
};

std::span<const FuzzEntry> fuzz_entries();

/// Null if there is none of this name.
const FuzzEntry* find_fuzz_entry(std::string_view name);

}  // namespace pl::test
