#include <filesystem>
#include <fstream>
#include <set>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
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
    }  // requested pictures are written before the end
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(bench.options.screenshot_dir))
        names.insert(entry.path().filename().string());
    CHECK(names == std::set<std::string>{"small-default-0001.png", "small-default-0002.exr", "small-default-0002.png",
                                         "small-default-0003.png"});
    ImageMetadata metadata;
    CHECK(read_exr(bench.options.screenshot_dir / "small-default-0002.exr", &metadata).width == 64);
    CHECK(text_of(metadata, "command") == "pathlight render small");
}
