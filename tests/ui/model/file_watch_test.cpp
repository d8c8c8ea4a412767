// Files that other programs change: complete changes are reported once, and those under way are waited for.
#include "ui/model/file_watch.h"

#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/fake_backend.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

FileStamp stamp(std::uintmax_t bytes) { return {.is_there = true, .written = {}, .bytes = bytes}; }

}  // namespace

TEST_CASE("File watch: a change is reported once, when two looks see the same") {
    ChangeDetector detector({stamp(1), stamp(1)});
    CHECK_FALSE(detector.look({stamp(1), stamp(1)}));
    CHECK_FALSE(detector.look({stamp(1), stamp(2)}));  // under way
    CHECK_FALSE(detector.look({stamp(1), stamp(3)}));
    CHECK(detector.look({stamp(1), stamp(3)}) == 1u);
    CHECK_FALSE(detector.look({stamp(1), stamp(3)}));
    CHECK_FALSE(detector.look({FileStamp{}, stamp(3)}));
    CHECK(detector.look({FileStamp{}, stamp(3)}) == 0u);  // removed
    // Written and restored in between: nothing to load.
    CHECK_FALSE(detector.look({stamp(1), stamp(3)}));
    CHECK_FALSE(detector.look({FileStamp{}, stamp(3)}));
    CHECK_FALSE(detector.look({FileStamp{}, stamp(3)}));
}

TEST_CASE("File watch: stamps distinguish contents of other lengths, and the lack of a file") {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "1");
    const FileStamp first = stamp_of(file);
    CHECK(first.is_there);
    CHECK(stamp_of(file) == first);
    folder.write("a", "22");
    CHECK(stamp_of(file) != first);
    CHECK(stamp_of(folder.path() / "none") == FileStamp{});
}

TEST_CASE("File watch: the thread reports the file, and files of an older order no more") {
    const TemporaryFolder folder;
    const auto a = folder.write("a", "1");
    const auto b = folder.write("b", "1");
    FileWatch watch;
    CHECK_FALSE(watch.take_change());
    watch.watch({a, b});
    std::string text = "1";
    std::optional<std::filesystem::path> changed;
    // The first look may come after the first change: others follow, with time for the file to rest.
    REQUIRE(eventually([&] {
        folder.write("b", text += "1");
        for (int i = 0; i < 20 && !changed; ++i) {
            std::this_thread::sleep_for(FileWatch::kInterval / 4);
            changed = watch.take_change();
        }
        return changed.has_value();
    }));
    CHECK(changed == b);
}
