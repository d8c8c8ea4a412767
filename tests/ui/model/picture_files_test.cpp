#include <fstream>

#include "tests/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Picture files: saves both formats under one new number") {
    FileBench bench;
    std::ofstream(bench.options.screenshot_dir / "small-default-0001.png") << "x";
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.files().pictures().save_exr_and_png();
        CHECK(model.messages().toasts().back().level == MessageLevel::Warning);  // nothing to save yet
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        model.files().pictures().save_exr_and_png();
        model.files().pictures().save_png();
    }  // what was asked for is written before the end
    const auto name = [&](const char* file) { return bench.options.screenshot_dir / file; };
    REQUIRE(bench.saved.size() == 3);
    CHECK(bench.saved[0] == name("small-default-0002.exr"));
    CHECK(bench.saved[1] == name("small-default-0002.png"));
    CHECK(bench.saved[2] == name("small-default-0003.png"));
}
