// Files of learned fields: the same bits back, and a refusal for everything else.
#include "core/io/field_file.h"

#include <cstddef>
#include <cstring>

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/small_field.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/sealed_bytes.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/same_bits.h"

using namespace pl;
using pl::test::contains;
using pl::test::error_message;
using pl::test::input_error;
using pl::test::kChecksumBytes;
using pl::test::kPrefixBytes;
using pl::test::loads_or_refuses;
using pl::test::sealed;
using pl::test::small_field;
using pl::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

using pl::test::same_bits;
bool same_bits(const HostArray<SurfacePoint>& a, const HostArray<SurfacePoint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SurfacePoint& p, const SurfacePoint& q) {
        constexpr std::size_t kWithoutPadding = offsetof(SurfacePoint, front);
        return std::memcmp(&p, &q, kWithoutPadding) == 0 && p.front == q.front;
    });
}

void check_same(const LearnedField& a, const LearnedField& b) {
    CHECK(a.method == b.method);
    CHECK(a.scene_hash == b.scene_hash);
    CHECK((a.settings == b.settings));
    CHECK(a.shape.cells.side == b.shape.cells.side);
    CHECK(a.shape.radiance_unit == b.shape.radiance_unit);
    CHECK((a.shape.rate == b.shape.rate));
    CHECK(a.shape.extent == b.shape.extent);
    CHECK(a.shape.uniform_floor == b.shape.uniform_floor);
    CHECK((a.refinement == b.refinement));
    CHECK((a.progress == b.progress));
    const auto check = [](const auto& x, const auto& y) { CHECK(same_bits(x, y)); };
    zip(*a.volumes, *b.volumes, check);
    zip(tables_of(a.field), tables_of(b.field), check);
}

std::string written(const TemporaryFolder& folder, const LearnedField& field) {
    write_field(folder.path() / "field", field);
    return read_file(folder.path() / "field");
}

}  // namespace

TEST_CASE("A learned field comes back with the same bits") {
    const TemporaryFolder folder;
    const LearnedField field = small_field();
    const std::string bytes = written(folder, field);
    check_same(field, read_field(folder.path() / "field"));
    CHECK(folder.file_count() == 1);
    CHECK(sealed(bytes) == bytes);
}

TEST_CASE("A learned field without volumes comes back") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    field.volumes = std::make_shared<const HostVolumes>();
    field.field = {};
    field.refinement = {};
    field.progress.next_probe = 0;
    written(folder, field);
    check_same(field, read_field(folder.path() / "field"));
}

TEST_CASE("Equal fields make equal files, whatever lies between their members") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    const std::string bytes = written(folder, field);
    HostVolumes dirty = *field.volumes;
    for (SurfacePoint& site : dirty.sites) {
        const SurfacePoint clean = site;
        std::memset(static_cast<void*>(&site), 0xA5, sizeof site);
        site.position = clean.position;
        site.geometric_normal = clean.geometric_normal;
        site.shading_normal = clean.shading_normal;
        site.position_error = clean.position_error;
        site.primitive = clean.primitive;
        site.material = clean.material;
        site.front = clean.front;
    }
    field.volumes = std::make_shared<const HostVolumes>(std::move(dirty));
    CHECK(written(folder, field) == bytes);
}

TEST_CASE("A field file that is cut off anywhere or goes on is refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_field());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const fs::path path = folder.write("cut", bytes.substr(0, size));
        const std::string told = input_error([&] { read_field(path); });
        REQUIRE_THAT(told, contains("cut: ") && contains("expected") && contains("got"));
    }
    const fs::path longer = folder.write("longer", bytes + '\0');
    CHECK_THAT(input_error([&] { read_field(longer); }), contains("longer: damaged field: expected") &&
                                                             contains(std::to_string(bytes.size()) + " bytes") &&
                                                             contains("got " + std::to_string(bytes.size() + 1)));
}

TEST_CASE("A field file with any bit flipped is refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_field());
    for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i / 8] = static_cast<char>(changed[i / 8] ^ (1 << (i % 8)));
        const fs::path path = folder.write("flipped", changed);
        CAPTURE(i);
        REQUIRE_FALSE(loads_or_refuses([&] { read_field(path); }));
    }
}

// The checksum is right here, as if another program had written the file: sizes, counts and numbers of every kind.
// Only Error(Input) is allowed; a count that is trusted would allocate more memory than there is.
TEST_CASE("A field file with any byte replaced and sealed again is read or refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_field());
    int refused = 0;
    for (std::size_t i = kPrefixBytes; i + kChecksumBytes < bytes.size(); ++i) {
        for (const char byte : {'\xff', '\x7f', '\x00'}) {
            std::string changed = bytes;
            changed[i] = byte;
            const fs::path path = folder.write("replaced", sealed(changed));
            CAPTURE(i);
            refused += loads_or_refuses([&] { read_field(path); }) ? 0 : 1;
        }
    }
    CHECK(refused > 100);
}

TEST_CASE("Bytes that are missing or too many inside a sealed field file are refused") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_field());
    for (std::size_t i = kPrefixBytes; i + kChecksumBytes < bytes.size(); ++i) {
        std::string shorter = bytes;
        shorter.erase(i, 1);
        std::string longer = bytes;
        longer.insert(i, 1, '\x01');
        CAPTURE(i);
        const fs::path path = folder.write("shorter", sealed(shorter));
        REQUIRE_FALSE(loads_or_refuses([&] { read_field(path); }));
        const fs::path other = folder.write("longer", sealed(longer));
        REQUIRE_FALSE(loads_or_refuses([&] { read_field(other); }));
    }
}

TEST_CASE("A learned choice of lights rises to one or is missing") {
    const TemporaryFolder folder;
    const auto told = [&](std::vector<float> choice) {
        LearnedField field = small_field();
        std::get<HostTables>(field.field).light_cdf.assign(choice.begin(), choice.end());
        written(folder, field);
        return input_error([&] { read_field(folder.path() / "field"); });
    };
    CHECK_THAT(told({0.5f, 0.75f, 0, 0, 0, 0}),
               contains("entry 1 of the choices of lights") && contains("expected 1"));
    CHECK_THAT(told({0.5f, 1, 0.5f, 0, 0, 0}), contains("entry 3 of the choices of lights"));
    CHECK_THAT(told({0.5f, 1, 0, 0, -0.5f, 1}), contains("entry 4 of the choices of lights"));
}

TEST_CASE("Other files and other versions are no damaged fields") {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, small_field());
    const auto told = [&](const std::string& content) {
        const fs::path path = folder.write("f", content);
        return input_error([&] { read_field(path); });
    };
    CHECK_THAT(told(""), contains("f: not a learned field: expected a file that begins with PLFIELD"));
    CHECK_THAT(told("v 0 0 0\n"), contains("not a learned field") && contains("got 76 20 30"));
    std::string newer = bytes;
    newer[8] = 11;
    CHECK_THAT(told(newer), contains("another version: expected 10, got 11"));
    CHECK_THAT(input_error([&] { read_field(folder.path() / "gone"); }), contains("gone: cannot be read"));
    CHECK_THAT(input_error([&] { read_field(folder.path()); }), contains("it is a directory"));
}

TEST_CASE("A field that cannot be written leaves nothing") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "missing" / "field";
    CHECK_THAT(error_message(ErrorKind::Runtime, [&] { write_field(path, small_field()); }),
               contains("cannot be written"));
    CHECK(folder.file_count() == 0);
}
