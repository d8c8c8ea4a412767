// The collection of files that were broken once: tests/corpus/refused must be refused with file and line or reason,
// tests/corpus/accepted must load. A new file only has to be put there.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"

using namespace pl;
using pl::test::contains;

namespace {

std::vector<std::filesystem::path> scenes_in(const std::string& folder) {
    std::vector<std::filesystem::path> result;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PL_SOURCE_DIR) + "/tests/corpus/" + folder)) {
        const std::string suffix = entry.path().extension().string();
        if (suffix == ".obj" || suffix == ".json") {
            result.push_back(entry.path());
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

TEST_CASE("Corpus: files to be refused") {
    const auto paths = scenes_in("refused");
    CHECK(paths.size() >= 10);
    for (const auto& path : paths) {
        INFO(path);
        CHECK_THAT(test::input_error([&] { load_scene(path.string(), ""); }), contains(path.stem().string()));
    }
}

TEST_CASE("Corpus: files to be loaded") {
    const auto paths = scenes_in("accepted");
    CHECK(paths.size() >= 5);
    for (const auto& path : paths) {
        INFO(path);
        CHECK_FALSE(load_scene(path.string(), "").triangles.empty());
    }
}
