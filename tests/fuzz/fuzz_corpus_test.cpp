// The corpora of the fuzzers as plain tests, and damaged copies of them: for compilers that have no libFuzzer.
#include <algorithm>
#include <filesystem>
#include <random>

#include <fmt/format.h>

#include "core/io/checkpoint_file.h"
#include "core/io/field_file.h"
#include "core/io/files.h"
#include "tests/fuzz/entries.h"
#include "tests/support/catch.hpp"
#if PL_FUZZ_SCRIPTS
#include "tests/fuzz/play_script.h"
#include "tests/support/files/sealed_bytes.h"
#endif

using namespace pl;
using namespace pl::test;
namespace fs = std::filesystem;

namespace {

/// Files of a folder, sorted by name; with a suffix only those.
std::vector<std::string> contents_of(const fs::path& folder, const std::string& suffix = "") {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder))
        if (suffix.empty() || entry.path().extension() == suffix) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> contents;
    for (const fs::path& path : paths) contents.push_back(read_file(path));
    return contents;
}

/// The entry's own corpus, and the files of its kind in tests/corpus.
std::vector<std::string> corpus_of(const std::string& name) {
    const fs::path tests = fs::path(PL_SOURCE_DIR) / "tests";
    std::vector<std::string> corpus = contents_of(tests / "fuzz/corpus" / name);
    if (name == "obj" || name == "json")
        for (const char* half : {"accepted", "refused"})
            for (const std::string& content : contents_of(tests / "corpus" / half, "." + name))
                corpus.push_back(content);
    if (name == "script")
        for (const std::string& content : contents_of(tests / "ui/scripts", ".script")) corpus.push_back(content);
    return corpus;
}

std::string damaged(std::string bytes, std::mt19937& random) {
    for (auto edits = 1 + random() % 4; edits > 0 && !bytes.empty(); --edits) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 4) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8)); break;
        case 2: bytes.erase(at, 1 + random() % 16); break;
        default: bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 16));
        }
    }
    return bytes;
}

void run_damaged(int copies, unsigned seed) {
    std::mt19937 random(seed);
    for (const FuzzEntry& entry : fuzz_entries()) {
        const std::vector<std::string> corpus = corpus_of(std::string(entry.name));
        for (int i = 0; i < copies; ++i) entry.run(damaged(corpus[random() % corpus.size()], random));
    }
    SUCCEED("a defect would have ended the program");
}

}  // namespace

TEST_CASE("Every file of every corpus is read or refused", "[hard]") {
    for (const FuzzEntry& entry : fuzz_entries()) {
        const std::vector<std::string> corpus = corpus_of(std::string(entry.name));
        INFO(entry.name);
        CHECK(corpus.size() >= 4);
        for (const std::string& bytes : corpus) entry.run(bytes);
        entry.run("");
    }
}

// Seed 5; libFuzzer finds more, where it is.
TEST_CASE("Damaged copies of the corpora are read or refused", "[hard]") { run_damaged(1500, 5); }
TEST_CASE("A hundred thousand damaged copies of the corpora are read or refused", "[hard][nightly]") {
    run_damaged(100000, 6);
}

#if PL_FUZZ_SCRIPTS
TEST_CASE("Scripts of the corpora are played on the viewer's model and panels", "[hard]") {
    const auto play = [](const char* script) { play_script(parse_script(script, "s")); };
    const std::string click =
        "3 aim_at 0.5 0.5 Paths\n4 down left\n5 up left\n8 aim_at 0.5 0.5 Trace the clicked pixel";
    CHECK_NOTHROW(play(click.c_str()));
    CHECK_THROWS_WITH(play("3 aim_at 0.5 0.5 Trace the clicked pixel"),
                      contains("there is no control 'Trace the clicked pixel'"));
    CHECK_THROWS_WITH(play("0 tap Tab\n3 aim_at 0.5 0.5 Paths"), contains("there is no control 'Paths'"));
    CHECK_NOTHROW(play("0 tap Tab\n2 tap Tab\n6 aim_at 0.5 0.5 Paths"));
    // Lobes come from the helper thread, and are drawn without a renderer here.
    std::string lobes = "0 tap 3\n1 tap U\n";
    for (int frame = 3; frame < 180; frame += 3) lobes += fmt::format("{} move {} 9\n", frame, frame);
    CHECK_NOTHROW(play(lobes.c_str()));
}
#endif

// Files of an older version are only refused: then the program make_sealed_corpora has to write the corpora anew.
TEST_CASE("The corpus of fields holds one of this version", "[hard]") {
    const std::filesystem::path folder = std::filesystem::path(PL_SOURCE_DIR) / "tests/fuzz/corpus/field";
    CHECK_NOTHROW(read_field(folder / "small"));
    CHECK_NOTHROW(read_field(folder / "empty"));
    CHECK_THROWS(read_field(folder / "cut"));
    CHECK_THROWS(read_field(folder / "other"));
    const std::string small = read_file(folder / "small");
    CHECK(sealed(small) == small);
}
TEST_CASE("The corpus of checkpoints holds one of this version", "[hard]") {
    const std::filesystem::path folder = std::filesystem::path(PL_SOURCE_DIR) / "tests/fuzz/corpus/checkpoint";
    CHECK_NOTHROW(read_checkpoint(folder / "small"));
    CHECK_NOTHROW(read_checkpoint(folder / "unplaced"));
    CHECK_THROWS(read_checkpoint(folder / "cut"));
    CHECK_THROWS(read_checkpoint(folder / "other"));
    const std::string small = read_file(folder / "small");
    CHECK(sealed(small) == small);
}
