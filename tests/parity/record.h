// Records for device_tables.py: one line of standard output, "@kind" and then "key=value" fields, all separated by tabs.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace pl::parity {

/// Prints its line, complete and flushed, when it goes out of scope: a program that is killed has lost no finished record.
class Record {
public:
    explicit Record(std::string_view kind) : line_(fmt::format("@{}", kind)) {}
    ~Record() {
        std::puts(line_.c_str());
        std::fflush(stdout);
    }
    Record(const Record&) = delete;
    Record& operator=(const Record&) = delete;

    /// Adds a field. Values must have no tabs and no line ends.
    template <class T>
    Record& field(std::string_view key, const T& value) {
        line_ += fmt::format("\t{}={}", key, value);
        return *this;
    }

private:
    std::string line_;
};

}  // namespace pl::parity
