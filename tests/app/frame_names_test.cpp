// Names of the files of a sequence.
#include "app/frame_names.h"

#include "core/base/error.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

std::string refused(const std::string& pattern) {
    try {
        FrameNames names(pattern);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Usage);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("Frame names: the number in its place, with leading zeros") {
    CHECK(FrameNames("frame_%04d.exr").name(7) == "frame_0007.exr");
    CHECK(FrameNames("frame_%04d.exr").name(12345) == "frame_12345.exr");
    CHECK(FrameNames("a/b%d").name(10) == "a/b10");
    CHECK(FrameNames("%02d.png").name(0) == "00.png");
    CHECK(FrameNames("{}%d{}.png").name(3) == "{}3{}.png");
}

TEST_CASE("Frame names: anything else is refused with what is expected") {
    for (const std::string pattern :
         {"frame.exr", "", "%", "%s.png", "%4d.png", "%00d.png", "%0d.png", "%d%d.png", "%d_%.png", "%%d"})
        CHECK(refused(pattern) == "--output: expected a name with the place of the frame's number once, such as "
                                  "frame_%04d.exr, got '" +
                                      pattern + "'");
}
