// The memory that is left here: of the machine, within the limits of control groups and of the process. Work that needs more is
// refused before it begins: the kernel would end the program without a word.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/base/error.h"

namespace pl {

/// Work that does not fit the memory that is left. It says nothing about a file: no reader may go on without what was refused, or
/// pictures would depend on the machine.
class MemoryError : public Error {
public:
    using Error::Error;
};

/// Bytes that this process can still take, now. The largest number where the system says nothing.
std::uint64_t memory_left();

/// Bytes that a machine has left by its files, such as /proc/meminfo, below a folder: with swap, and within the control groups
/// (version 2 or 1) of the process and all above them. Memory that only caches files is not in use.
std::uint64_t memory_left_by_files(const std::filesystem::path& root);

/// Tells how many processes share the work on this machine, each with arrays of its own; one until then.
void set_processes_here(int count);

/// Throws MemoryError if `subject` needs more bytes than are left: some once, and some in each process that shares the work here, since
/// all make room at the same time. Of less than a megabyte it takes no notice.
void require_memory(std::string_view subject, std::uint64_t bytes, ErrorKind kind, std::uint64_t bytes_of_each = 0);

}  // namespace pl
