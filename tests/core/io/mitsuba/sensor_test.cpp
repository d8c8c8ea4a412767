// Sensors of Mitsuba scenes: their angles, mirrored ones, planes of clipping.
#include "core/io/mitsuba/sensor.h"

#include <cmath>

#include <fmt/format.h>

#include "core/scene/pack_scene.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription seen_by(const std::string& values, int width, int height) {
    return load_mitsuba_text(kSquare + fmt::format("<sensor type=\"perspective\">{}<film type=\"hdrfilm\"><integer "
                                                   "name=\"width\" value=\"{}\"/><integer name=\"height\" "
                                                   "value=\"{}\"/></film></sensor>",
                                                   values, width, height));
}

double tangent(const std::string& values, int width, int height) {
    return std::tan(0.5 * glm::radians(static_cast<double>(seen_by(values, width, height).camera.fov_deg)));
}

std::string place(const std::string& steps) { return "<transform name=\"to_world\">" + steps + "</transform>"; }

const std::string kAhead = "<lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/>";

}  // namespace

// The diagonal of 35 mm film is 43.267 mm; of 4:3 the height is 3/5 of the diagonal.
TEST_CASE("mitsuba sensors: focal lengths, and 50 mm without an angle, span the diagonal") {
    const auto half = [](double millimeters) { return 0.5 * std::hypot(36.0, 24.0) / millimeters; };
    CHECK(tangent("<string name=\"focal_length\" value=\"35mm\"/>", 64, 48) == Approx(0.6 * half(35.0)));
    CHECK(tangent("<string name=\"focalLength\" value=\"35\"/>", 48, 64) == Approx(0.8 * half(35.0)));
    CHECK(tangent("", 64, 64) == Approx(std::sqrt(0.5) * half(50.0)));
    CHECK_THAT(input_error([] { tangent("<string name=\"focal_length\" value=\"0mm\"/>", 64, 64); }),
               contains("'focal_length': expected millimeters above 0"));
}

TEST_CASE("mitsuba sensors: the axis that an angle spans") {
    const auto of = [](const std::string& axis, int width, int height) {
        return tangent("<float name=\"fov\" value=\"60\"/><string name=\"fov_axis\" value=\"" + axis + "\"/>", width,
                       height);
    };
    const double half = std::tan(glm::radians(30.0));
    CHECK(of("x", 80, 40) == Approx(half / 2.0));
    CHECK(of("y", 80, 40) == Approx(half));
    CHECK(of("smaller", 80, 40) == Approx(half));
    CHECK(of("larger", 80, 40) == Approx(half / 2.0));
    CHECK(of("smaller", 40, 80) == Approx(2.0 * half));
    CHECK(of("larger", 40, 80) == Approx(half));
    CHECK(of("diagonal", 40, 30) == Approx(0.6 * half));
    CHECK_THAT(input_error([&] { of("z", 80, 40); }), contains("'fov_axis': expected x, y, diagonal"));
}

TEST_CASE("mitsuba sensors: mirrored places swap right and left") {
    CHECK_FALSE(seen_by(place(kAhead), 8, 8).camera.is_mirrored);
    CHECK_FALSE(seen_by(place("<scale x=\"-1\"/><scale x=\"-1\"/>" + kAhead), 8, 8).camera.is_mirrored);
    const CameraDescription mirrored = seen_by(place("<scale x=\"-1\"/>" + kAhead), 8, 8).camera;
    REQUIRE(mirrored.is_mirrored);
    CHECK(make_camera(mirrored, 8, 8).right.x < 0.0f);
    CHECK(make_camera(mirrored, 8, 8).up.y > 0.0f);
    const CameraDescription upside_down = seen_by(place("<scale y=\"-1\"/>" + kAhead), 8, 8).camera;
    CHECK(make_camera(upside_down, 8, 8).right.x > 0.0f);
    CHECK(make_camera(upside_down, 8, 8).up.y < 0.0f);
}

// A point that is seen at (16, 10) of 48 x 32 pixels is seen at the same place of a mirrored camera in a mirrored world.
TEST_CASE("mitsuba sensors: a crop and a principal point are those of the picture, mirrored or not") {
    const std::string cut = "<float name=\"fov\" value=\"50\"/><float name=\"principal_point_offset_x\" "
                            "value=\"-0.2\"/><float name=\"principal_point_offset_y\" value=\"0.15\"/>";
    const std::string crop = "<integer name=\"crop_offset_x\" value=\"5\"/><integer name=\"crop_offset_y\" "
                             "value=\"3\"/><integer name=\"crop_width\" value=\"30\"/><integer "
                             "name=\"crop_height\" value=\"24\"/>";
    const auto seen = [&](const glm::vec3& mirror, const std::string& film, glm::vec2 size) {
        const std::string steps = fmt::format("<scale x=\"{}\" y=\"{}\" z=\"{}\"/>", mirror.x, mirror.y, mirror.z);
        const SceneDescription scene = load_mitsuba_text(
            kSquare + fmt::format("<sensor type=\"perspective\">{}{}<film type=\"hdrfilm\"><integer name=\"width\" "
                                  "value=\"48\"/><integer name=\"height\" value=\"32\"/>{}</film></sensor>",
                                  cut, place(steps + kAhead), film));
        const Camera camera = make_camera(scene.camera, static_cast<int>(size.x), static_cast<int>(size.y));
        const glm::vec3 point = glm::vec3(-0.9f, 0.4f, 5.0f) * mirror;  // 5 ahead, in the frame of the camera
        return film_position(camera, glm::vec3(-point.x, point.y, 5.0f - point.z), size).film;
    };
    const double focal = 24.0 / std::tan(glm::radians(25.0));
    const glm::dvec2 wanted(24.0 + 0.2 * 48.0 + focal * 0.9 / 5.0, 16.0 - 0.15 * 32.0 - focal * 0.4 / 5.0);
    for (const glm::vec3& mirror : {glm::vec3(1, 1, 1), glm::vec3(-1, 1, 1), glm::vec3(1, -1, 1),
                                    glm::vec3(-1, -1, 1), glm::vec3(1, 1, -1), glm::vec3(-1, -1, -1)}) {
        CHECK(glm::length(glm::dvec2(seen(mirror, "", {48, 32})) - wanted) < 1e-3);
        CHECK(glm::length(glm::dvec2(seen(mirror, crop, {30, 24})) + glm::dvec2(5, 3) - wanted) < 1e-3);
    }
}

// The square of 2 x 2 is 5 ahead.
TEST_CASE("mitsuba sensors: planes of clipping are told where something is behind them") {
    const auto clipped = [](double near, double far) {
        return seen_by(place(kAhead) + fmt::format("<float name=\"near_clip\" value=\"{}\"/><float name=\"far_clip\" "
                                                   "value=\"{}\"/>",
                                                   near, far),
                       8, 8);
    };
    const std::string nearer = "what is nearer than near_clip, 6, is shown";
    CHECK(is_told(clipped(6.0, 100.0), nearer));
    CHECK(is_told(clipped(1.0, 4.0), "what is farther than far_clip, 4, is shown"));
    const SceneDescription plain = clipped(4.0, 6.0);
    CHECK(std::ranges::none_of(plain.warnings,
                               [](const std::string& text) { return text.find("_clip") != std::string::npos; }));
}

TEST_CASE("mitsuba sensors: what the picture does not show is not told to be behind a plane of clipping") {
    const auto told = [](const std::string& shapes, const std::string& values) {
        const SceneDescription scene = load_mitsuba_text(
            shapes + "<sensor type=\"perspective\">" + values + place(kAhead) +
            "<film type=\"hdrfilm\"><integer name=\"width\" value=\"8\"/><integer name=\"height\" value=\"8\"/>"
            "</film></sensor>");
        return is_told(scene, "_clip");
    };
    const auto shape = [](const std::string& steps) {
        return "<shape type=\"rectangle\">" + place(steps) + "</shape>";
    };
    const std::string near = "<float name=\"fov\" value=\"60\"/><float name=\"near_clip\" value=\"2\"/>";
    // Bounds of a leaning wall have the eye inside, but the wall passes by.
    const std::string lean = "<scale value=\"20\"/><rotate y=\"1\" angle=\"45\"/>";
    CHECK_FALSE(told(shape(lean + "<translate x=\"10\"/>"), near));
    CHECK(told(shape(lean + "<translate x=\"4\"/>"), near));
    CHECK(told(shape("<translate x=\"1\" z=\"3.5\"/>"), near));
    const std::string shifted = "<float name=\"principal_point_offset_x\" value=\"0.5\"/>";
    CHECK_FALSE(told(shape("<scale value=\"0.1\"/><translate x=\"0.5\" z=\"3.5\"/>"), near + shifted) ==
                told(shape("<scale value=\"0.1\"/><translate x=\"-0.5\" z=\"3.5\"/>"), near + shifted));
    const std::string group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"rectangle\"/></shape>";
    const auto instance = [](const std::string& steps) {
        return "<shape type=\"instance\"><ref id=\"g\"/>" + place(steps) + "</shape>";
    };
    CHECK_FALSE(told(group + instance("<translate z=\"0.5\"/>"), near));
    CHECK(told(group + instance("<translate z=\"3.5\"/>"), near));
}
