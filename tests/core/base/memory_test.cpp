#include "core/base/memory.h"

#include <limits>

#include <sys/resource.h>

#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::TemporaryFolder;

namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;

/// The files of a machine, below a folder.
class Machine {
public:
    void put(const std::string& name, const std::string& text) const { (void)root_.write(name, text); }
    std::uint64_t left() const { return memory_left_by_files(root_.path()); }

private:
    TemporaryFolder root_;
};

const std::string kMeminfo =
    "MemTotal:       25165824 kB\nMemFree:         1048576 kB\n"
    "MemAvailable:   16777216 kB\nSwapTotal:             0 kB\nSwapFree:              0 kB\n";

}  // namespace

TEST_CASE("A machine has left what is available, and its swap") {
    const Machine machine;
    CHECK(machine.left() == std::numeric_limits<std::uint64_t>::max());
    machine.put("proc/meminfo", kMeminfo);
    CHECK(machine.left() == 16 * kGiB);
    machine.put("proc/meminfo", "MemAvailable: 1048576 kB\nSwapFree: 1048576 kB\n");
    CHECK(machine.left() == 2 * kGiB);
}

TEST_CASE("A control group of version 2 has left its limit less what it uses, files in memory apart") {
    const Machine machine;
    machine.put("proc/meminfo", kMeminfo);
    machine.put("proc/self/cgroup", "0::/user/render\n");
    machine.put("sys/fs/cgroup/user/render/memory.max", "max\n");
    machine.put("sys/fs/cgroup/user/render/memory.current", "1073741824\n");
    CHECK(machine.left() == 16 * kGiB);
    machine.put("sys/fs/cgroup/user/render/memory.max", "4294967296\n");
    CHECK(machine.left() == 3 * kGiB);
    machine.put("sys/fs/cgroup/user/render/memory.stat", "anon 1\ninactive_file 536870912\nactive_file 268435456\n");
    CHECK(machine.left() == 3 * kGiB + 3 * kGiB / 4);

    SECTION("and no more than the groups that it is in") {
        machine.put("sys/fs/cgroup/user/memory.max", "2147483648\n");
        machine.put("sys/fs/cgroup/user/memory.current", "3221225472\n");
        CHECK(machine.left() == 0);
    }
    SECTION("with swap as far as it may") {
        machine.put("proc/meminfo", "MemAvailable: 16777216 kB\nSwapFree: 2097152 kB\n");
        CHECK(machine.left() == 5 * kGiB + 3 * kGiB / 4);
        machine.put("sys/fs/cgroup/user/render/memory.swap.max", "1073741824\n");
        machine.put("sys/fs/cgroup/user/render/memory.swap.current", "1073741824\n");
        CHECK(machine.left() == 3 * kGiB + 3 * kGiB / 4);
    }
}

TEST_CASE("A control group of version 1 has left its limit less what it uses") {
    const Machine machine;
    machine.put("proc/meminfo", kMeminfo);
    machine.put("proc/self/cgroup", "7:cpu,memory:/docker/abc\n1:name=systemd:/\n");
    // As a container sees it: its own group at the root.
    machine.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "2147483648\n");
    machine.put("sys/fs/cgroup/memory/memory.usage_in_bytes", "1610612736\n");
    machine.put("sys/fs/cgroup/memory/memory.stat", "inactive_file 1\ntotal_inactive_file 536870912\n");
    CHECK(machine.left() == kGiB);
}

TEST_CASE("Work that does not fit is refused with both numbers of bytes") {
    CHECK_NOTHROW(require_memory("a picture", 1 << 21, ErrorKind::Usage));
    try {
        require_memory("a picture", std::uint64_t{1} << 60, ErrorKind::Usage);
        FAIL("it fits");
    } catch (const MemoryError& error) {
        INFO(error.what());
        CHECK(error.kind() == ErrorKind::Usage);
        CHECK(std::string(error.what()).starts_with("a picture: "));
        CHECK(std::string(error.what()).find("1152921504606846976 bytes") != std::string::npos);
    }
}

TEST_CASE("Processes that share the work of a machine need their memory together") {
    const std::uint64_t part = memory_left() / 2;
    CHECK_NOTHROW(require_memory("a scene", 0, ErrorKind::Input, part));
    set_processes_here(4);
    const auto words = [](std::uint64_t once, std::uint64_t each) {
        try {
            require_memory("a scene", once, ErrorKind::Input, each);
        } catch (const MemoryError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string together = words(0, part);
    const std::string once = words(part, 0);
    const std::string huge = words(1, std::numeric_limits<std::uint64_t>::max() / 2);
    set_processes_here(1);
    CHECK(together.ends_with(" in the 4 processes of this machine"));
    CHECK(once.empty());
    CHECK(huge.find("18446744073709551615 bytes") != std::string::npos);
}

TEST_CASE("The limit of the address space counts") {
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
    const rlimit small{1, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_AS, &small) == 0);
    const std::uint64_t left = memory_left();
    setrlimit(RLIMIT_AS, &before);
    CHECK(left == 0);
}
