// Colors of Mitsuba scenes: codes of sRGB, and spectra by wavelength, from files and of plugins.
#include "core/io/mitsuba/spectra.h"

#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

glm::vec3 albedo(const std::string& color, const std::string& version = "3.0.0", const TemporaryFolder& folder = {}) {
    const std::string scene = "<scene version=\"" + version + "\"><shape type=\"rectangle\"><bsdf type=\"diffuse\">" +
                              color + "</bsdf></shape></scene>";
    return load_scene(folder.write("s.xml", scene).string(), "").materials.at(0).albedo;
}

glm::vec3 radiance(const std::string& color, const std::string& version = "3.0.0") {
    const TemporaryFolder folder;
    const std::string scene = "<scene version=\"" + version + "\">" + kSquare + "<emitter type=\"constant\">" +
                              color + "</emitter></scene>";
    return load_scene(folder.write("s.xml", scene).string(), "").environment;
}

/// Within a relative 0.2 % of the largest channel: Mitsuba's sums of a flat spectrum are 0.1 % below it.
bool are_near(const glm::vec3& color, const glm::vec3& expected) {
    const float most = 0.002f * std::max({expected.x, expected.y, expected.z});
    return glm::all(glm::lessThan(glm::abs(color - expected), glm::vec3(most)));
}

}  // namespace

// Values of Mitsuba 3.9.1, scalar_rgb; of black bodies and irregular spectra, which that does not have, scalar_spectral.
TEST_CASE("mitsuba colors: spectra by wavelength are lit by D65, or shine by themselves") {
    CHECK(are_near(albedo("<spectrum name=\"reflectance\" value=\"400:0.05, 550:0.05, 600:0.6, 700:0.6\"/>"),
                   {0.722266f, 0.107566f, 0.0291009f}));
    CHECK(are_near(albedo("<spectrum name=\"reflectance\" value=\"400:0.5 700:0.7\"/>"),
                   {0.658501f, 0.595169f, 0.524663f}));
    CHECK(are_near(albedo("<spectrum name=\"reflectance\" value=\"300:0.5, 1000:0.7\"/>"),
                   {0.597229f, 0.568787f, 0.539589f}));
    CHECK(albedo("<spectrum name=\"reflectance\" value=\"0.5\"/>") == glm::vec3(0.5f));
    CHECK(are_near(radiance("<spectrum name=\"radiance\" value=\"400:0, 500:8, 600:15.6, 700:18.4\"/>"),
                   {20.7108f, 10.8546f, 2.77115f}));
    CHECK(are_near(radiance("<spectrum name=\"radiance\" value=\"2\"/>"), {2.40959f, 1.89658f, 1.81783f}));
    CHECK(radiance("<spectrum name=\"radiance\" value=\"2\"/>", "0.6.0") == glm::vec3(2.0f));
    CHECK(radiance("<spectrum type=\"d65\" name=\"radiance\"><float name=\"scale\" value=\"3\"/></spectrum>") ==
          glm::vec3(3.0f));
    CHECK(radiance("<spectrum type=\"d65\" name=\"radiance\"><rgb name=\"color\" value=\"1 2 3\"/></spectrum>") ==
          glm::vec3(1, 2, 3));
    CHECK(radiance("<spectrum type=\"uniform\" name=\"radiance\"><float name=\"value\" value=\"3\"/></spectrum>") ==
          glm::vec3(3.0f));
    CHECK(are_near(radiance("<spectrum type=\"irregular\" name=\"radiance\"><string name=\"wavelengths\" "
                            "value=\"400,500,700\"/><string name=\"values\" value=\"1,9,2\"/></spectrum>"),
                   radiance("<spectrum name=\"radiance\" value=\"400:1, 500:9, 700:2\"/>")));
    CHECK(are_near(radiance("<spectrum type=\"regular\" name=\"radiance\"><float name=\"wavelength_min\" "
                            "value=\"400\"/><float name=\"wavelength_max\" value=\"700\"/><string name=\"values\" "
                            "value=\"1,9,2\"/></spectrum>"),
                   radiance("<spectrum name=\"radiance\" value=\"400:1, 550:9, 700:2\"/>")));
}

TEST_CASE("mitsuba colors: black bodies, of both versions") {
    const glm::vec3 body = radiance(
        "<spectrum type=\"blackbody\" name=\"radiance\"><float name=\"temperature\" value=\"5000\"/></spectrum>");
    // Its wavelengths were sampled: within 1 %.
    CHECK(glm::all(glm::lessThan(glm::abs(body / glm::vec3(15275.2f, 12095.0f, 9623.9f) - 1.0f), glm::vec3(0.01f))));
    CHECK(radiance("<blackbody name=\"radiance\" temperature=\"5000K\" scale=\"2\"/>", "0.6.0") == 2.0f * body);
}

TEST_CASE("mitsuba colors: spectra from files, and codes of sRGB") {
    const TemporaryFolder folder;
    folder.write("r.spd", "# a comment\n400 0.05\n\n550 0.05\n600 0.6\r\n700 0.6\n");
    CHECK(are_near(albedo("<spectrum name=\"reflectance\" filename=\"r.spd\"/>", "3.0.0", folder),
                   {0.722266f, 0.107566f, 0.0291009f}));
    const glm::vec3 orange = albedo("<srgb name=\"reflectance\" value=\"#ff8000\"/>", "0.6.0");
    CHECK(orange.x == 1.0f);
    CHECK(orange.y == Approx(0.21586f).epsilon(1e-4));
    CHECK(orange.z == 0.0f);
    CHECK(albedo("<rgb name=\"reflectance\" value=\"#FF8000\"/>", "0.6.0") == orange);
    CHECK(albedo("<srgb name=\"reflectance\" value=\"1, 0.50196, 0\"/>", "0.6.0").y ==
          Approx(0.21586f).epsilon(1e-3));
}

TEST_CASE("mitsuba colors: broken spectra are refused with file and line") {
    const auto refused = [](const std::string& color) {
        return refusal("<shape type=\"rectangle\"><bsdf type=\"diffuse\">" + color + "</bsdf></shape>");
    };
    const auto list = [&](const std::string& value) {
        return refused("<spectrum name=\"reflectance\" value=\"" + value + "\"/>");
    };
    CHECK_THAT(list("400:0.5"), contains("s.xml:2") && contains("two or more wavelengths"));
    CHECK_THAT(list("700:0.5, 400:0.7"), contains("expected wavelengths that rise, got 400 after 700"));
    CHECK_THAT(list("400:0.5, 400:0.7"), contains("that rise"));
    CHECK_THAT(list(":"), contains("expected pairs"));
    CHECK_THAT(list("#ff80"), contains("expected finite numbers"));
    CHECK_THAT(refused("<spectrum name=\"reflectance\" filename=\"../r.spd\"/>"),
               contains("in the folder of the scene"));
    CHECK_THAT(refused("<spectrum name=\"reflectance\" filename=\"none.spd\"/>"), contains("none.spd"));
    CHECK_THAT(refused("<blackbody name=\"reflectance\" temperature=\"0\"/>"), contains("kelvins above 0"));
    const TemporaryFolder folder;
    folder.write("r.spd", "400 0.05\n500\n");
    CHECK_THAT(input_error([&] { albedo("<spectrum name=\"reflectance\" filename=\"r.spd\"/>", "3.0.0", folder); }),
               contains("r.spd:2: expected a wavelength and a value"));
}
