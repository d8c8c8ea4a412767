// Picture files: display values of every kind of view, and files that cannot be written.
// Names of the files of a sequence.
#include "core/io/picture_file.h"

#include <cmath>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;

namespace pl::test {
namespace {

Snapshot tiny_picture(View view, const std::vector<Vec3f>& pixels) {
    Snapshot snapshot;
    snapshot.slot.view = view;
    snapshot.width = static_cast<int>(pixels.size());
    snapshot.height = 1;
    snapshot.pixels = pixels;
    return snapshot;
}

}  // namespace

TEST_CASE("exposure and tone curve apply to radiance, not to data") {
    const Vec3f half(0.25f);
    const DisplaySettings display{.exposure_ev = 1.0f, .curve = ToneCurve::Reinhard};
    // 0.25 * 2 / (1 + 0.5) = 1/3; sRGB of 1/3 and 1/4 from the standard's formula.
    CHECK(int{display_image(tiny_picture(View::Beauty, {half}), display).rgb[0]} == 156);
    CHECK(int{display_image(tiny_picture(View::Normal, {half}), display).rgb[0]} == 137);
    CHECK(int{display_image(tiny_picture(View::Depth, {Vec3f{10.0f}, Vec3f{40.0f}}), display).rgb[0]} == 137);
    const ByteImage invalid = display_image(tiny_picture(View::Beauty, {Vec3f{std::nanf("")}}), display);
    CHECK((invalid.rgb == std::vector<std::uint8_t>{255, 0, 255}));
}

TEST_CASE("heat maps are shown in their colors, whatever the exposure") {
    const DisplaySettings display{.exposure_ev = 3.0f, .curve = ToneCurve::Reinhard};
    const ByteImage image =
        display_image(tiny_picture(View::Visits, {Vec3f{0.0f}, Vec3f{20.0f}, Vec3f{10.0f}}), display);
    CHECK((image.rgb == std::vector<std::uint8_t>{43, 23, 81, 248, 235, 122, 7, 140, 147}));
    const ByteImage share = display_image(tiny_picture(View::Unvisited, {Vec3f{0.5f}}), display);
    CHECK((share.rgb == std::vector<std::uint8_t>{7, 140, 147}));
}

TEST_CASE("a file that cannot be written is found out beforehand, without a trace") {
    const TemporaryFolder folder;
    const std::filesystem::path old = folder.write("old.png", "old");
    CHECK_NOTHROW(require_writable(folder.path() / "new.png"));
    CHECK_NOTHROW(require_writable(old));
    CHECK(folder.file_count() == 1);
    CHECK(read_file(old) == "old");
    CHECK_NOTHROW(require_writable("/dev/null"));
    for (const std::filesystem::path& path : {folder.path() / "missing/new.png", folder.path(), old / "x.png"}) {
        try {
            require_writable(path);
            FAIL(path.string() << " counts as writable");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::Runtime);
            CHECK_THAT(error.what(), contains(path.string()));
        }
    }
}

}  // namespace pl::test

TEST_CASE("Frame files: numbered from 1 with at least four digits, and of the kind that their suffix tells") {
    CHECK(frame_file("a/b", 0, ImageKind::Png) == "a/b/frame_0001.png");
    CHECK(frame_file("a/b", 12344, ImageKind::Exr) == "a/b/frame_12345.exr");
    for (const ImageKind kind : {ImageKind::Exr, ImageKind::Pfm, ImageKind::Png})
        CHECK(image_kind(frame_file("f", 7, kind)) == kind);
}
