#include "ui/model/file_names.h"

#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using namespace pl::ui;

TEST_CASE("Numbered names: no file is ever hit twice") {
    const test::TemporaryFolder folder;
    const std::filesystem::path& dir = folder.path();
    std::ofstream(dir / "box-0001.png") << "x";
    std::ofstream(dir / "box-0003.exr") << "x";
    NumberedNames names;
    CHECK(names.next(dir, "box", {".exr", ".png"}) == dir / "box-0002");
    // Not written yet, and still taken.
    CHECK(names.next(dir, "box", {".exr", ".png"}) == dir / "box-0004");
    CHECK(file_name_part("my scene/a.b") == "my-scene-a-b");
    CHECK(file_name_part("") == "picture");
}
