// Small pictures of scenes: named by all that decides them, and read only if they are whole.
#include "ui/model/thumbnail.h"

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/fake_backend.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

ByteImage gray_picture() {
    const auto bytes = static_cast<std::size_t>(3 * kThumbnailWidth * kThumbnailHeight);
    return {.width = kThumbnailWidth, .height = kThumbnailHeight, .rgb = std::vector<std::uint8_t>(bytes, 77)};
}

}  // namespace

TEST_CASE("Thumbnail: its name follows from light and camera, not from names") {
    SceneDescription scene = *small_scene();
    const std::string name = thumbnail_name(scene);
    CHECK(name.size() == 20);
    scene.name = "other";
    CHECK(thumbnail_name(scene) == name);
    scene.camera.eye.x += 1.0f;
    CHECK(thumbnail_name(scene) != name);
    scene = *small_scene();
    scene.materials[0].albedo.x = 0.25f;
    CHECK(thumbnail_name(scene) != name);
}

TEST_CASE("Thumbnail: a file is read as it was written, damaged ones and other pictures are not") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "a.png";
    CHECK_FALSE(read_thumbnail(file));
    const ByteImage picture = gray_picture();
    write_thumbnail(file, picture);
    const auto read = read_thumbnail(file);
    REQUIRE(read);
    CHECK(read->rgb == picture.rgb);
    const std::string bytes = read_file(file);
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 30}) {
        CAPTURE(size);
        folder.write("a.png", bytes.substr(0, size));
        CHECK_FALSE(read_thumbnail(file));
    }
    write_png8(file, picture);  // of another program
    CHECK_FALSE(read_thumbnail(file));
}

TEST_CASE("Thumbnail: rendered in its size, nothing if it is stopped") {
    const FakeDevices devices;
    StopFlag stop{false};
    const auto picture = render_thumbnail(small_scene(), devices.maker(), false, &stop);
    REQUIRE(picture);
    CHECK(picture->width == kThumbnailWidth);
    CHECK(picture->height == kThumbnailHeight);
    stop = true;
    CHECK_FALSE(render_thumbnail(small_scene(), devices.maker(), false, &stop));
}
