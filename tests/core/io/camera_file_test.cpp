// Cameras in JSON files: those that are written are read to the bit, and faults are told with their line.
#include "core/io/camera_file.h"

#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::TemporaryFolder;

namespace {

std::string refused_cameras(const std::string& text) {
    const TemporaryFolder folder;
    const auto file = folder.write("path.json", text);
    return input_error([&] { load_cameras(file, {}); });
}

std::string with_cameras(const std::string& cameras) {
    return "{\n\"schema\": \"pathlight.cameras/1\",\n\"cameras\": " + cameras + "\n}\n";
}

}  // namespace

TEST_CASE("Cameras that are written are read to the bit") {
    CameraDescription first;
    first.eye = {0.1f, 1.0f / 3.0f, -2.7e-7f};
    first.target = {5.0f, 6.25f, 1.0e8f};
    first.fov_deg = 33.3f;
    first.aperture_radius = 0.07f;
    first.focus_distance = 1.7f;
    first.shift = {0.25f, -0.125f};
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "path.json";
    save_cameras(file, std::vector{first, CameraDescription{}});
    const std::vector<CameraDescription> read = load_cameras(file, {});
    REQUIRE(read.size() == 2);
    CHECK(read[0].eye == first.eye);
    CHECK(read[0].target == first.target);
    CHECK(read[0].up == first.up);
    CHECK(read[0].fov_deg == first.fov_deg);
    CHECK(read[0].aperture_radius == first.aperture_radius);
    CHECK(read[0].focus_distance == first.focus_distance);
    CHECK(read[0].shift == first.shift);
    CHECK(read[1].eye == CameraDescription{}.eye);
}

TEST_CASE("A camera without a member has that of the scene") {
    CameraDescription standard;
    standard.target = {1.0f, 2.0f, 3.0f};
    standard.fov_deg = 71.0f;
    const TemporaryFolder folder;
    const auto file = folder.write("path.json", with_cameras("[{\"eye\": [7, 8, 9]}]"));
    const std::vector<CameraDescription> read = load_cameras(file, standard);
    REQUIRE(read.size() == 1);
    CHECK(read[0].eye == glm::vec3(7.0f, 8.0f, 9.0f));
    CHECK(read[0].target == standard.target);
    CHECK(read[0].fov_deg == 71.0f);
}

TEST_CASE("Faults of a file of cameras are told with file and line") {
    CHECK_THAT(refused_cameras("{\"cameras\": []}"), contains("expected \"pathlight.cameras/1\", got none"));
    CHECK_THAT(refused_cameras("{\n\"schema\": \"pathlight.scene/1\"}"),
               contains("path.json:2: 'schema': expected "));
    CHECK_THAT(refused_cameras(with_cameras("[{\n\"eye\": [1, 2]}]")), contains("path.json:4: 'cameras/0/eye'"));
    CHECK_THAT(refused_cameras(with_cameras("[{\n\"fov_deg\": 180}]")), contains("an angle between 0 and 180"));
    CHECK_THAT(refused_cameras(with_cameras("[{\n\"eyes\": [1, 2, 3]}]")), contains("did you mean 'eye'?"));
    CHECK_THAT(refused_cameras(with_cameras("[{\n\"eye\": [1, 2, 3], \"target\": [1, 2, 3]}]")),
               contains("got the same point for both"));
    CHECK_THAT(refused_cameras(with_cameras("[{\n\"up\": [0, 0, 0]}]")), contains("expected a direction"));
    CHECK_THAT(refused_cameras(with_cameras("[7]")), contains("expected an object"));
    CHECK_THAT(refused_cameras(with_cameras("7")), contains("expected an array"));
}
