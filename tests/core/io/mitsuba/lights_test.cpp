// Sky and sun of Mitsuba scenes of 3 and 0.6.
#include "core/io/mitsuba/lights.h"

#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription under(const std::string& emitters) { return load_mitsuba_text(kSquare + emitters); }

/// Column of the brightest texel in a row of the environment map.
std::size_t brightest_column(const SceneDescription& scene, std::size_t row) {
    const EnvironmentMapDescription& map = scene.environment_map;
    const auto first = map.texels.begin() + static_cast<std::ptrdiff_t>(row * map.width);
    const auto best =
        std::max_element(first, first + map.width, [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
    return static_cast<std::size_t>(best - first);
}

}  // namespace

TEST_CASE("mitsuba sky: sun and sky stand where the direction says, around the axis of the emitter") {
    const SceneDescription scene =
        under("<emitter type=\"sunsky\"><vector name=\"sun_direction\" x=\"0\" y=\"1\" z=\"1\"/><transform "
              "name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/></transform></emitter>");
    CHECK(glm::length(scene.sun.direction - glm::normalize(glm::vec3(0, 1, 1))) < 1e-6f);
    CHECK(scene.sun.radiance.y > 1e4f);
    // y is up: the lower half of the map is dark; +z is at its border.
    CHECK(scene.environment_map.texels[192 * 512].y == 0.0f);
    const std::size_t column = brightest_column(scene, 64);
    CHECK((column <= 2 || column >= 509));
    CHECK_FALSE(is_told(scene, "sun"));
}

TEST_CASE("mitsuba sky: in 0.6 y is up, and sky and sun may be emitters of their own") {
    const TemporaryFolder folder;
    const auto older = [&](const std::string& emitters) {
        const std::string text = "<scene version=\"0.6.0\">" + kSquare + emitters + "</scene>";
        return load_scene(folder.write("s.xml", text).string(), "");
    };
    const std::string direction = "<vector name=\"sunDirection\" x=\"1\" y=\"1\" z=\"0\"/>";
    const SceneDescription both = older("<emitter type=\"sky\">" + direction + "</emitter><emitter type=\"sun\">" +
                                        direction + "<float name=\"scale\" value=\"2\"/></emitter>");
    CHECK(both.environment_map.texels[0].y > 0.0f);
    CHECK(both.environment_map.texels[192 * 512].y == 0.0f);
    const SceneDescription one = older("<emitter type=\"sunsky\">" + direction + "</emitter>");
    CHECK(both.environment_map.texels == one.environment_map.texels);
    CHECK(both.sun.radiance == 2.0f * one.sun.radiance);
    CHECK_FALSE(is_told(both, "of two skies"));
    const SceneDescription two = older("<emitter type=\"sky\"/><emitter type=\"sky\"/>");
    CHECK(is_told(two, "of two skies, environment maps or suns the first one is shown"));
    CHECK(two.sun.radiance == glm::vec3(0.0f));
}

TEST_CASE("mitsuba sky: without a direction the sun stands where place, date and time put it") {
    // x is to the south and y to the west.
    const glm::vec3 afternoon = under("<emitter type=\"sunsky\"/>").sun.direction;
    CHECK(glm::length(afternoon - glm::vec3(0.0514f, 0.6918f, 0.7203f)) < 1e-3f);
    const auto at_hour = [](const char* hour) {
        return under(
            std::string(
                "<emitter type=\"sunsky\"><integer name=\"month\" value=\"1\"/><float name=\"hour\" value=\"") +
            hour + "\"/></emitter>");
    };
    const glm::vec3 winter = at_hour("11.7").sun.direction;
    CHECK(winter.x > 0.8f);
    CHECK(winter.z == Approx(0.53f).margin(0.02));  // 32 degrees
    CHECK_FALSE(is_told(at_hour("11.7"), "horizon"));
    const SceneDescription night = at_hour("23");
    CHECK(is_told(night, "the sun is below the horizon: its sky is black"));
    CHECK(night.sun.radiance == glm::vec3(0.0f));
}

TEST_CASE("mitsuba sky: in 0.6 x is to the east of a date and z to the south") {
    const TemporaryFolder folder;
    const std::string text = "<scene version=\"0.6.0\">" + kSquare + "<emitter type=\"sunsky\"/></scene>";
    const glm::vec3 sun = load_scene(folder.write("s.xml", text).string(), "").sun.direction;
    CHECK(glm::length(sun - glm::vec3(-0.6918f, 0.7203f, 0.0514f)) < 1e-3f);
}

TEST_CASE("mitsuba sky: values out of range are refused with their place") {
    CHECK_THAT(refusal(kSquare + "<emitter type=\"sunsky\"><float name=\"turbidity\" value=\"11\"/></emitter>"),
               contains("s.xml:2: 'turbidity': expected a number from 1 to 10, got 11"));
    CHECK_THAT(refusal(kSquare + "<emitter type=\"sunsky\"><float name=\"sky_scale\" value=\"-1\"/></emitter>"),
               contains("'sky_scale'"));
    CHECK_THAT(refusal(kSquare + "<emitter type=\"sunsky\"><integer name=\"month\" value=\"13\"/></emitter>"),
               contains("'month': expected a number from 1 to 12, got 13"));
    CHECK_THAT(refusal(kSquare + "<emitter type=\"sunsky\"><rgb name=\"albedo\" value=\"2\"/></emitter>"),
               contains("'albedo': expected a color within [0, 1]"));
    CHECK_THAT(refusal(kSquare + "<emitter type=\"sunsky\"><vector name=\"sun_direction\" x=\"0\" y=\"0\" "
                                 "z=\"0\"/></emitter>"),
               contains("expected a direction"));
}
