// Devices of ranks, without a device.
#include "mpi/rank_device.h"

#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("The ranks of a machine take its devices in turns") {
    const auto taken = [](const char* visible, int devices) {
        std::vector<std::string> names;
        for (int rank = 0; rank < 5; ++rank) names.push_back(visible_device(visible, devices, rank));
        return names;
    };
    using Names = std::vector<std::string>;
    CHECK(taken(nullptr, 2) == Names{"0", "1", "0", "1", "0"});
    CHECK(taken(nullptr, 8) == Names{"0", "1", "2", "3", "4"});
    CHECK(taken(nullptr, 1) == Names(5, "0"));
    // Those that a batch scheduler gives to a job are no others of the machine.
    CHECK(taken("4,6,7", 8) == Names{"4", "6", "7", "4", "6"});
    CHECK(taken("GPU-1a,MIG-2b", 8) == Names{"GPU-1a", "MIG-2b", "GPU-1a", "MIG-2b", "GPU-1a"});
    CHECK(taken("3,5,-1,6", 8) == Names{"3", "5", "3", "5", "3"});
    // A rank that was given one has that.
    CHECK(taken("5", 8) == Names(5, "5"));
}

TEST_CASE("Where there is no device to choose the variable stays as it is") {
    CHECK(visible_device(nullptr, 0, 3).empty());
    CHECK(visible_device("", 8, 3).empty());
    CHECK(visible_device("-1", 8, 3).empty());
    CHECK(visible_device(",", 8, 0).empty());
}

TEST_CASE("Devices are counted by their files") {
    const TemporaryFolder folder;
    CHECK(count_device_files(folder.path()) == 0);
    CHECK(count_device_files(folder.path() / "none") == 0);
    for (const char* name : {"nvidia0", "nvidia11", "nvidiactl", "nvidia-uvm", "nvidia", "null"})
        folder.write(name, "");
    CHECK(count_device_files(folder.path()) == 2);
}
