// Checkpoints in files: exact, and refused unless whole and of this version.
#include "core/io/checkpoint_file.h"

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/small_checkpoint.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/sealed_bytes.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using namespace pl::test;

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kVersionOffset = 8;

std::string written(const TemporaryFolder& folder, const Checkpoint& checkpoint) {
    write_checkpoint(folder.path() / "written", checkpoint);
    return read_file(folder.path() / "written");
}

}  // namespace

TEST_CASE("A checkpoint is read as it was written") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_checkpoint());
    const Checkpoint read = read_checkpoint(folder.path() / "written");
    CHECK(read.seconds == 12.5);
    CHECK(read.state.identity[1].second == "1");
    CHECK(read.state.is_closed == true);
    CHECK(read.state.placement->refinement.added == 1);
    CHECK(read.state.films[0].progress.counters.path.method.lookup_misses == 77);
    CHECK(read.state.films[0].pixels[4].second_sum.z == 1.0e300);
    CHECK(read.state.films[0].pixels[5].emission.varies == 3);
    CHECK(read.state.films[0].progress.runs == small_checkpoint().state.films[0].progress.runs);
    CHECK(read.state.films[0].progress.updates_seen == 4);
    CHECK(read.state.films[0].progress.guiding.schedule().warm_up == 4);
    CHECK(read.state.films[1].progress.guiding.schedule().warm_up == 0);
    CHECK(read.state.fields[0].progress == small_checkpoint().state.fields[0].progress);
    CHECK(written(folder, read) == bytes);
}

TEST_CASE("A checkpoint that is cut off, goes on or has a wrong bit is refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_checkpoint());
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
        const fs::path path = folder.write("cut", bytes.substr(0, size));
        REQUIRE_THAT(input_error([&] { read_checkpoint(path); }), contains("cut: ") && contains("checkpoint"));
    }
    const fs::path longer = folder.write("longer", bytes + '\0');
    CHECK_THAT(input_error([&] { read_checkpoint(longer); }), contains("longer: damaged checkpoint: expected"));
    for (std::size_t i = 0; i < 8 * bytes.size(); i += 13) {
        std::string changed = bytes;
        changed[i / 8] = static_cast<char>(changed[i / 8] ^ (1 << (i % 8)));
        const fs::path path = folder.write("flipped", changed);
        REQUIRE_FALSE(loads_or_refuses([&] { read_checkpoint(path); }));
    }
}

TEST_CASE("Other files, other versions and missing files are no checkpoints") {
    const TemporaryFolder folder;
    CHECK_THAT(input_error([&] { read_checkpoint(folder.path() / "none"); }), contains("no such file"));
    CHECK_THAT(input_error([&] { read_checkpoint(folder.write("f", "PLFIELD\n")); }),
               contains("f: not a checkpoint: expected a file that begins with PLCHECK"));
    std::string bytes = written(folder, small_checkpoint());
    bytes[kVersionOffset] = 99;
    CHECK_THAT(input_error([&] { read_checkpoint(folder.write("f", sealed(bytes))); }),
               contains("f: checkpoint of another version: expected 13, got 99"));
}

TEST_CASE("A checkpoint whose forgotten volumes do not exist is refused") {
    const TemporaryFolder folder;
    for (const std::int32_t volume : {-1, kVolumes}) {
        Checkpoint checkpoint = small_checkpoint();
        checkpoint.state.fields[0].progress.forgotten = {0, volume};
        written(folder, checkpoint);
        CHECK_THAT(input_error([&] { read_checkpoint(folder.path() / "written"); }),
                   contains("forgotten volume: expected one of 3, got " + std::to_string(volume)));
    }
    Checkpoint checkpoint = small_checkpoint();
    checkpoint.state.fields[0].arrays = {};
    written(folder, checkpoint);
    CHECK_THAT(input_error([&] { read_checkpoint(folder.path() / "written"); }),
               contains("expected one of 0, got 0"));
}

// As if another program had written the file. Only Error(Input) is allowed.
TEST_CASE("A checkpoint with any byte replaced and sealed again is read or refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_checkpoint());
    int refused = 0;
    for (std::size_t i = kPrefixBytes; i + kChecksumBytes < bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i] = '\xff';
        const fs::path path = folder.write("replaced", sealed(changed));
        CAPTURE(i);
        refused += loads_or_refuses([&] { read_checkpoint(path); }) ? 0 : 1;
    }
    CHECK(refused > 100);
}
