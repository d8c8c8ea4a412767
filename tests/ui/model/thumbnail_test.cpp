// Small pictures of cameras are read only if they are whole.
#include "ui/model/thumbnail.h"

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

ByteImage gray_picture() {
    const auto bytes = static_cast<std::size_t>(3 * kThumbnailWidth * kThumbnailHeight);
    return {.width = kThumbnailWidth, .height = kThumbnailHeight, .rgb = std::vector<std::uint8_t>(bytes, 77)};
}

}  // namespace

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
