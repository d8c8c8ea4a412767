// Names of the files of a sequence.
#include "core/io/frame_file.h"

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Frame files: numbered from 1 with at least four digits, and of the kind that their suffix tells") {
    CHECK(frame_file("a/b", 0, ImageKind::Png) == "a/b/frame_0001.png");
    CHECK(frame_file("a/b", 12344, ImageKind::Exr) == "a/b/frame_12345.exr");
    for (const ImageKind kind : {ImageKind::Exr, ImageKind::Pfm, ImageKind::Png})
        CHECK(image_kind(frame_file("f", 7, kind)) == kind);
}
