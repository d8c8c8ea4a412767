// Whole field files whose numbers no session could have learned: each is refused by name.
// Files of learned fields: the same bits back, and a refusal for everything else.
#include "core/io/field_file.h"

#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>

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
using pl::test::kVolumes;
using pl::test::loads_or_refuses;
using pl::test::sealed;
using pl::test::small_field;
using pl::test::TemporaryFolder;

namespace {

struct Wrong {
    std::string message;
    std::function<void(LearnedField&, HostVolumes&)> change;
};

std::vector<Wrong> wrong_settings() {
    using F = LearnedField;
    using V = HostVolumes;
    return {
        {"a method that learns, got 'default'", [](F& f, V&) { f.method = MethodId::Default; }},
        {"volumes asked for: expected 0 or more, got -1", [](F& f, V&) { f.settings.volumes = -1; }},
        {"budget: expected a number of megabytes, got nan", [](F& f, V&) { f.settings.budget_megabytes = kNan; }},
        {"bins: expected a square number from 4 to 1024, got 5", [](F& f, V&) { f.settings.bins = 5; }},
        {"bins: expected a square number", [](F& f, V&) { f.settings.bins = 33 * 33; }},
        {"bins: expected a square number", [](F& f, V&) { f.settings.bins = -4; }},
        {"learning rate: expected one of 1 (mean), 4 (forgetful), got 5",
         [](F& f, V&) { f.settings.rate = static_cast<LearningRate>(5); }},
        {"learning rate: expected one of 1 (mean), 4 (forgetful), got 2",
         [](F& f, V&) { f.settings.rate = static_cast<LearningRate>(2); }},
        {"learning rate: expected one of 1 (mean), 4 (forgetful), got 3",
         [](F& f, V&) { f.settings.rate = static_cast<LearningRate>(3); }},
        {"learning rate: expected one of 1 (mean), 4 (forgetful), got 0",
         [](F& f, V&) { f.settings.rate = static_cast<LearningRate>(0); }},
        {"learning target: expected one of 0 (expected-sarsa), 1 (sarsa), 2 (monte-carlo), got 3",
         [](F& f, V&) { f.settings.learning.target = static_cast<LearningTarget>(3); }},
        {"learned light: expected one of 0 (all), 1 (indirect), got 2",
         [](F& f, V&) { f.settings.learning.light = static_cast<LearnedLight>(2); }},
        {"uniform share: expected 0 to 1, got nan", [](F& f, V&) { f.settings.uniform_floor = kNan; }},
        {"precomputed samples: expected a square number", [](F& f, V&) { f.settings.precompute_samples = 0; }},
        {"precomputed samples: expected a square number",
         [](F& f, V&) { f.settings.precompute_samples = std::numeric_limits<int>::max(); }},
        {"share of added volumes: expected 0 to 1, or -1, got nan", [](F& f, V&) { f.settings.refine_share = kNan; }},
        {"added volumes: expected at most 3, got 4", [](F& f, V&) { f.refinement.added = 4; }},
        {"cells to a side: expected the root of 4 bins, got 3", [](F& f, V&) { f.shape.cells.side = 3; }},
        {"cells to a side: expected the root of 4 bins, got -2", [](F& f, V&) { f.shape.cells.side = -2; }},
        {"cells to a side: expected the root of 4 bins, got 2147483647",
         [](F& f, V&) { f.shape.cells.side = std::numeric_limits<int>::max(); }},
        {"radiance unit: expected a power of two, got 3", [](F& f, V&) { f.shape.radiance_unit = 3.0f; }},
        {"radiance unit: expected a power of two, got 0", [](F& f, V&) { f.shape.radiance_unit = 0.0f; }},
        {"radiance unit: expected a power of two, got nan", [](F& f, V&) { f.shape.radiance_unit = kNan; }},
        {"extent: expected 0 or more, got nan", [](F& f, V&) { f.shape.extent = kNan; }},
        {"expected those of the settings", [](F& f, V&) { f.shape.rate = LearningRate::Forgetful; }},
        {"precomputed slices: expected at most 9, got 10", [](F& f, V&) { f.progress.precomputed_slices = 10; }},
        {"next probe: expected 0, or below 12, got 12", [](F& f, V&) { f.progress.next_probe = 12; }},
        {"next probe: expected 0, or below 0, got 11", [](F& f, V&) { f.progress.precomputed_slices = 9; }},
    };
}

std::vector<Wrong> wrong_volumes() {
    using F = LearnedField;
    using V = HostVolumes;
    return {
        {"place of volume 1: expected a finite position, got 1,nan", [](F&, V& v) { v.sites[1].position.y = kNan; }},
        {"place of volume 0: expected an error bound", [](F&, V& v) { v.sites[0].position_error = -1.0f; }},
        {"normal of volume 2: expected a vector of length 1", [](F&, V& v) { v.normals[2].x = 0.1f; }},
        {"normal of volume 2: expected a vector of length 1", [](F&, V& v) { v.sites[2].shading_normal.x = kNan; }},
        {"places: expected 3 values, got 2", [](F&, V& v) { v.sites.pop_back(); }},
        {"search tree: expected at most 3 values, got 4", [](F&, V& v) { v.kd_nodes.push_back(v.kd_nodes[0]); }},
        {"node 2 of the search tree: expected a volume below 3, got 3", [](F&, V& v) { v.kd_nodes[2].volume = 3; }},
        {"node 0 of the search tree: expected a volume below 3, got 4294967295",
         [](F&, V& v) { v.kd_nodes[0].volume = 0xffffffffu; }},
        {"node 1 of the search tree: expected an axis from 0 to 2, got 3", [](F&, V& v) { v.kd_nodes[1].axis = 3; }},
        {"node 1 of the search tree: expected the position", [](F&, V& v) { v.kd_nodes[1].position.z = kNan; }},
        {"node 1 of the search tree: expected the normal", [](F&, V& v) { v.kd_nodes[1].normal.y *= -1.0f; }},
    };
}

std::vector<Wrong> wrong_tables() {
    using F = LearnedField;
    using V = HostVolumes;
    return {
        {"radiance: expected 12 values, got 11", [](F& f, V&) { tables_of(f.field).radiance.pop_back(); }},
        {"visits: expected 12 values, got 13", [](F& f, V&) { tables_of(f.field).visits.push_back(1); }},
        {"sums: expected 12 values, got 0", [](F& f, V&) { tables_of(f.field).pending_sum.clear(); }},
        {"counts: expected 12 values, got 11", [](F& f, V&) { tables_of(f.field).pending_count.pop_back(); }},
        {"row table: expected 6 values, got 7", [](F& f, V&) { tables_of(f.field).row_cdf.push_back(1.0f); }},
        {"column table: expected 12 values, got 11", [](F& f, V&) { tables_of(f.field).column_cdf.pop_back(); }},
        {"mean radiance: expected 3 values, got 2", [](F& f, V&) { tables_of(f.field).mean_radiance.pop_back(); }},
        {"radiance of cell 7: expected 0 or more, got nan", [](F& f, V&) { tables_of(f.field).radiance[7] = kNan; }},
        {"radiance of cell 7: expected 0 or more, got -1", [](F& f, V&) { tables_of(f.field).radiance[7] = -1.0f; }},
        {"mean radiance of volume 2: expected 0 or more, got inf",
         [](F& f, V&) { tables_of(f.field).mean_radiance[2] = std::numeric_limits<float>::infinity(); }},
        {"inverse reaches: expected 3 values, got 2", [](F& f, V&) { tables_of(f.field).inverse_reach.pop_back(); }},
        {"inverse reach of volume 1: expected 0 or more, got -1",
         [](F& f, V&) { tables_of(f.field).inverse_reach[1] = -1.0f; }},
        {"distance of volume 2: expected 0 to 5, got 6",
         [](F& f, V&) { tables_of(f.field).pending_light[2] = 5, tables_of(f.field).pending_distance[2] = 6; }},
        {"sum of cell 3: expected 0 to", [](F& f, V&) { tables_of(f.field).pending_sum[3] = -1; }},
        {"sum of cell 3: expected 0 to 0", [](F& f, V&) { tables_of(f.field).pending_count[3] = 0; }},
        {"entry 1 of the row table: expected 1, got 0.99", [](F& f, V&) { tables_of(f.field).row_cdf[1] = 0.99f; }},
        {"entry 2 of the row table: expected a probability", [](F& f, V&) { tables_of(f.field).row_cdf[2] = 1.5f; }},
        {"entry 4 of the column table: expected a probability",
         [](F& f, V&) { tables_of(f.field).column_cdf[4] = -0.1f; }},
        {"entry 4 of the column table: expected a probability",
         [](F& f, V&) { tables_of(f.field).column_cdf[4] = kNan; }},
        {"entry 11 of the column table: expected 1, got nan",
         [](F& f, V&) { tables_of(f.field).column_cdf[11] = kNan; }},
    };
}

}  // namespace

TEST_CASE("Whole field files with numbers that no session could have learned are refused") {
    const TemporaryFolder folder;
    for (const auto& wrongs : {wrong_settings(), wrong_volumes(), wrong_tables()}) {
        for (const Wrong& wrong : wrongs) {
            LearnedField field = small_field();
            HostVolumes volumes = *field.volumes;
            wrong.change(field, volumes);
            field.volumes = std::make_shared<const HostVolumes>(std::move(volumes));
            write_field(folder.path() / "field", field);
            CHECK_THAT(input_error([&] { read_field(folder.path() / "field"); }),
                       contains("field: damaged field: ") && contains(wrong.message));
        }
    }
}

TEST_CASE("Damaged SD-trees in files are refused, whole ones come back") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    field.method = MethodId::Reinforcement;
    field.settings.representation = field.shape.representation = Representation::SdTree;
    field.field = make_field(field.shape, kVolumes, Representation::SdTree);
    const auto refused = [&](const std::function<void(LearnedField&)>& change) {
        LearnedField damaged = field;
        change(damaged);
        write_field(folder.path() / "field", damaged);
        return input_error([&] { read_field(folder.path() / "field"); });
    };
    write_field(folder.path() / "field", field);
    CHECK(std::get<HostSdTree>(read_field(folder.path() / "field").field).energy.size() == 4);
    const auto tree = [](LearnedField& f) -> HostSdTree& { return std::get<HostSdTree>(f.field); };
    CHECK_THAT(refused([&](LearnedField& f) { tree(f).spatial[0] = 0; }),
               contains("damaged field: SD-tree: expected each node"));
    CHECK_THAT(refused([&](LearnedField& f) { tree(f).child[2] = 7; }), contains("child of the quadrant 2: got 7"));
    CHECK_THAT(refused([&](LearnedField& f) { tree(f).energy[1] = kNan; }),
               contains("energy of quadrant 1: expected 0 or more, got nan"));
    CHECK_THAT(refused([&](LearnedField& f) { tree(f).visits.clear(); }),
               contains("visits: expected 1 values, got 0"));
    CHECK_THAT(refused([&](LearnedField& f) { tree(f).bsdf_fraction[0] = 0.0f; }),
               contains("BSDF share of leaf 0: expected 0.1 to 0.9, got 0"));
    CHECK_THAT(refused([&](LearnedField& f) { f.shape.edge = 0.0f; }),
               contains("edge of the cube: expected a length above 0"));
    CHECK_THAT(refused([&](LearnedField& f) { f.shape.most_nodes = 0; }),
               contains("nodes of quadtrees: expected 1 to"));
    CHECK_THAT(refused([&](LearnedField& f) { f.method = MethodId::Precomputed; }),
               contains("representation of the arrays: expected 0, got 1"));
    CHECK_THAT(refused([&](LearnedField& f) { f.settings.representation = static_cast<Representation>(5); }),
               contains("representation: expected one of 0 (table), 1 (sd-tree), 2 (lobes), 4 (neural), got 5"));
    CHECK_THAT(
        refused([&](LearnedField& f) { f.settings.representation = static_cast<Representation>(3); }),
        contains(
            "field of a representation that is no longer there: expected one of table, sd-tree, lobes, neural, got "
            "tables with a network as their prior"));
}

TEST_CASE("Damaged lobes in files are refused, whole ones come back") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    field.method = MethodId::Reinforcement;
    field.settings.representation = field.shape.representation = Representation::Lobes;
    field.field = make_field(field.shape, kVolumes, Representation::Lobes);
    const auto refused = [&](const std::function<void(HostLobes&)>& change) {
        LearnedField damaged = field;
        change(std::get<HostLobes>(damaged.field));
        write_field(folder.path() / "field", damaged);
        return input_error([&] { read_field(folder.path() / "field"); });
    };
    write_field(folder.path() / "field", field);
    CHECK(std::get<HostLobes>(read_field(folder.path() / "field").field).lobe_count[0] == kFirstLobes);
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.lobe_count[0] = kMostLobes + 1; }),
               contains("damaged field: lobes: expected mixtures of 1 to 16 lobes, got lobes of volume 0: got 17"));
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.weight[1] = 0.5f; }), contains("weights of volume 0: got 1.37"));
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.kappa[2] = -1.0f; }),
               contains("concentration of lobe 2: expected 0 or more, got -1"));
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.mean[3] = kNan; }),
               contains("mean of a lobe of place 3: expected a finite number, got nan"));
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.moments.clear(); }), contains("moments: expected"));
    CHECK_THAT(refused([](HostLobes& lobes) { lobes.bsdf_fraction[0] = 0.0f; }),
               contains("BSDF share of volume 0: expected 0.1 to 0.9, got 0"));
}

TEST_CASE("Damaged networks in files are refused, whole ones come back") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    field.method = MethodId::Reinforcement;
    field.settings.representation = field.shape.representation = Representation::Neural;
    field.field = make_field(field.shape, kVolumes, Representation::Neural);
    std::get<HostNeural>(field.field).counts[kNetworkSteps] = 9;
    const auto refused = [&](const std::function<void(HostNeural&)>& change) {
        LearnedField damaged = field;
        change(std::get<HostNeural>(damaged.field));
        write_field(folder.path() / "field", damaged);
        return input_error([&] { read_field(folder.path() / "field"); });
    };
    write_field(folder.path() / "field", field);
    CHECK(NeuralModel::network(std::get<HostNeural>(read_field(folder.path() / "field").field)).steps == 9);
    CHECK_THAT(refused([](HostNeural& neural) { neural.average[2] = kNan; }),
               contains("damaged field: average of place 2: expected a finite number, got nan"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.weights[3] = kInfinity; }),
               contains("weight of place 3: expected a finite number, got inf"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.slope_square[1] = -1.0f; }),
               contains("square of the slope of place 1: expected 0 or more, got -1"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.average.pop_back(); }),
               contains("averages of weights: expected"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.counts[kNetworkIsLost] = 2; }),
               contains("network: expected weights of layout 1, got mark of loss 2"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.counts[kNetworkVersion] = 9; }), contains("got layout 9"));
    CHECK_THAT(refused([](HostNeural& neural) { neural.column_cdf[0] = 2.0f; }),
               contains("entry 0 of the column table"));
}

// A table that is not monotonic would give a direction a negative probability; this takes at least four columns.
TEST_CASE("Probabilities that fall are refused") {
    const TemporaryFolder folder;
    LearnedField field = small_field();
    field.settings.bins = 16;
    field.shape.cells.side = 4;
    tables_of(field.field) = make_arrays<HostTables>(field.shape, kVolumes);
    write_field(folder.path() / "field", field);
    CHECK_NOTHROW(read_field(folder.path() / "field"));
    std::swap(tables_of(field.field).column_cdf[5], tables_of(field.field).column_cdf[6]);
    write_field(folder.path() / "field", field);
    CHECK_THAT(input_error([&] { read_field(folder.path() / "field"); }),
               contains("entry 6 of the column table: expected a probability from 0.75 to 1, got 0.5"));
}

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
