// Mitsuba scenes of 0.x and 3: emitters, camera, parameters and includes, and files that are refused.
#include "core/io/mitsuba/mitsuba.h"

#include "core/io/image.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("mitsuba: area and constant emitters, others are told") {
    const SceneDescription scene = load_mitsuba_text(
        "<shape type=\"rectangle\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"20, 3, "
        "3\"/></emitter></shape>" +
        kSquare +
        "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.3\"/></emitter><emitter type=\"projector\"/>");
    CHECK(scene.materials[scene.triangles[0].material].emission == glm::vec3(20, 3, 3));
    CHECK(scene.materials[scene.triangles[0].material].albedo == glm::vec3(0.0f));
    CHECK(scene.materials[scene.triangles[2].material].emission == glm::vec3(0.0f));
    CHECK(scene.environment == glm::vec3(0.3f));
    CHECK(is_told(scene, "emitters of the type 'projector' are left out"));
}

TEST_CASE("mitsuba: point, spot and directional emitters") {
    const std::string place = "<transform name=\"to_world\"><lookat origin=\"1, 2, 3\" target=\"1, 0, 3\" up=\"1, 0, "
                              "0\"/></transform>";
    const std::string spot = "<emitter type=\"spot\">" + place + "<float name=\"cutoff_angle\" value=\"";
    const SceneDescription scene = load_mitsuba_text(
        kSquare +
        "<emitter type=\"point\"><point name=\"position\" x=\"4\" y=\"5\" z=\"6\"/><rgb name=\"intensity\" "
        "value=\"1, 2, 3\"/></emitter>" +
        spot + "40\"/></emitter>" +
        "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"-2\" z=\"0\"/><rgb "
        "name=\"irradiance\" value=\"7\"/></emitter>");
    REQUIRE(scene.punctual_lights.size() == 3);
    CHECK(scene.punctual_lights[0].kind == PunctualKind::Point);
    CHECK(scene.punctual_lights[0].position == glm::vec3(4, 5, 6));
    CHECK(scene.punctual_lights[0].intensity == glm::vec3(1, 2, 3));
    CHECK(scene.punctual_lights[1].kind == PunctualKind::Spot);
    CHECK(scene.punctual_lights[1].falloff == SpotFalloff::Angle);
    CHECK(scene.punctual_lights[1].position == glm::vec3(1, 2, 3));
    CHECK(glm::length(scene.punctual_lights[1].direction - glm::vec3(0, -1, 0)) < 1e-6f);
    CHECK(scene.punctual_lights[1].inner_deg == 30.0f);
    CHECK(scene.punctual_lights[1].outer_deg == 40.0f);
    CHECK(scene.punctual_lights[2].kind == PunctualKind::Directional);
    CHECK(scene.punctual_lights[2].direction == glm::vec3(0, -1, 0));
    CHECK(scene.punctual_lights[2].intensity == glm::vec3(7.0f));
    const SceneDescription hard =
        load_mitsuba_text(kSquare + spot + "30\"/><float name=\"beam_width\" value=\"30\"/></emitter>");
    CHECK(hard.punctual_lights.at(0).inner_deg == 30.0f);
    CHECK(hard.punctual_lights.at(0).outer_deg == 30.0f);
    CHECK_THAT(input_error([&] { load_mitsuba_text(kSquare + spot + "0\"/></emitter>"); }),
               contains("0 < cutoff_angle"));
}

TEST_CASE("mitsuba: the camera, its angle across or upwards, and the size of the picture") {
    const std::string film = "<film type=\"hdrfilm\"><integer name=\"width\" value=\"640\"/><integer name=\"height\" "
                             "value=\"360\"/></film>";
    const std::string place =
        "<transform name=\"to_world\"><lookat origin=\"0, 1, 5\" target=\"0, 1, 0\" up=\"0, 1, 0\"/></transform>";
    const SceneDescription scene = load_mitsuba_text(
        kSquare + "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>" + place + film + "</sensor>");
    CHECK(scene.camera.eye == glm::vec3(0, 1, 5));
    CHECK(glm::length(glm::normalize(scene.camera.target - scene.camera.eye) - glm::vec3(0, 0, -1)) < 1e-6f);
    CHECK(scene.camera.up == glm::vec3(0, 1, 0));
    CHECK(scene.camera.fov_deg == Approx(35.98339777).epsilon(1e-5));
    CHECK(scene.setting("size") == "640x360");
    const SceneDescription upwards = load_mitsuba_text(
        kSquare +
        "<sensor type=\"thinlens\"><float name=\"fov\" value=\"60\"/><string name=\"fovAxis\" value=\"y\"/><float "
        "name=\"apertureRadius\" value=\"0.5\"/><float name=\"focusDistance\" value=\"3\"/>" +
        film + "</sensor>");
    CHECK(upwards.camera.fov_deg == Approx(60.0f));
    CHECK(upwards.camera.aperture_radius == 0.5f);
    CHECK(upwards.camera.focus_distance == 3.0f);
    CHECK(upwards.camera.target.z == 1.0f);
}

// Next to such an eye no float is 1 away.
TEST_CASE("mitsuba: a camera far from the origin looks along its axis") {
    const SceneDescription scene = load_mitsuba_text(
        kSquare + "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"3e10, 1e9, 5e10\" "
                  "target=\"1e10, 2e9, 1e10\" up=\"0, 1, 0\"/></transform></sensor>");
    const glm::dvec3 view = glm::normalize(glm::dvec3(scene.camera.target) - glm::dvec3(scene.camera.eye));
    CHECK(glm::length(view - glm::normalize(glm::dvec3(-2e10, 1e9, -4e10))) < 1e-4);
}

// 160 x 90 pixels of 640 x 360 from (320, 45) on, whose middle lies 80 pixels to the right of and 90 above the middle of the film.
TEST_CASE("mitsuba: scenes far from the origin are moved near it in doubles, with camera and lights") {
    const glm::dvec3 far(391234.37, 5820123.81, -3.5);
    const std::string move =
        "<transform name=\"to_world\"><scale value=\"0.01\"/><translate value=\"391234.37 5820123.81 "
        "-3.5\"/></transform>";
    const std::string at = "x=\"391234.37\" y=\"5820123.81\" z=\"-3.5\"/>";
    TemporaryFolder folder;
    folder.write("m.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n391234.37 5820123.81 -3.5\n"
                 "391234.38 5820123.81 -3.5\n391234.37 5820123.82 -3.5\n3 0 1 2\n");
    const SceneDescription scene = load_mitsuba_text(
        folder, "<shape type=\"rectangle\">" + move +
                    "</shape><shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/></shape>"
                    "<shape type=\"shapegroup\" id=\"g\"><shape type=\"rectangle\"/></shape>"
                    "<shape type=\"instance\"><ref id=\"g\"/>" +
                    move +
                    "</shape><shape type=\"sphere\"><float name=\"radius\" value=\"0.01\"/><point name=\"center\" " +
                    at + "</shape><emitter type=\"point\"><point name=\"position\" " + at +
                    "</emitter><emitter type=\"spot\">" + move +
                    "</emitter><sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"391234.37, "
                    "5820123.81, 1\" target=\"391234.37, 5820123.81, 0\" up=\"0, 1, 0\"/></transform></sensor>");
    const auto is_at = [&](const glm::vec3& point, const glm::dvec3& from) {
        return glm::length(scene.origin + glm::dvec3(point) - far - from) < 1e-5;
    };
    CHECK(is_told(scene, "far from the origin"));
    REQUIRE(scene.triangles.size() > 5);
    const auto corner = [&](std::size_t triangle, int k) {
        return scene.positions[scene.triangles[triangle].vertex[k]];
    };
    CHECK(is_at(corner(0, 0), {-0.01, -0.01, 0.0}));
    CHECK(is_at(corner(2, 1), {0.01, 0.0, 0.0}));
    CHECK(is_at(corner(3, 0), {-0.01, -0.01, 0.0}));
    glm::dvec3 top(-1.0);
    for (std::size_t i = 5; i < scene.triangles.size(); ++i) top = glm::max(top, glm::dvec3(corner(i, 0)));
    CHECK(is_at(top, glm::dvec3(0.01)));
    CHECK(is_at(scene.punctual_lights.at(0).position, glm::dvec3(0.0)));
    CHECK(is_at(scene.punctual_lights.at(1).position, glm::dvec3(0.0)));
    CHECK(is_at(scene.camera.eye, {0.0, 0.0, 4.5}));
}

TEST_CASE("mitsuba: crops of the film, and a principal point off its middle") {
    const auto sensor = [](const std::string& values, const std::string& crop) {
        return kSquare +
               "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/><string name=\"fov_axis\" "
               "value=\"y\"/>" +
               values +
               "<film type=\"hdrfilm\"><integer name=\"width\" value=\"640\"/><integer name=\"height\" "
               "value=\"360\"/>" +
               crop + "</film></sensor>";
    };
    const std::string crop =
        "<integer name=\"crop_offset_x\" value=\"320\"/><integer name=\"crop_offset_y\" value=\"45\"/>"
        "<integer name=\"crop_width\" value=\"160\"/><integer name=\"crop_height\" value=\"90\"/>";
    const SceneDescription cropped = load_mitsuba_text(sensor("", crop));
    CHECK(std::ranges::none_of(cropped.warnings,
                               [](const std::string& text) { return text.find("crop") != std::string::npos; }));
    CHECK(cropped.setting("size") == "160x90");
    CHECK(std::tan(glm::radians(0.5f * cropped.camera.fov_deg)) == Approx(0.25f * std::tan(glm::radians(30.0f))));
    CHECK(cropped.camera.shift.x == Approx(80.0f / 90.0f));
    CHECK(cropped.camera.shift.y == Approx(1.0f));
    const SceneDescription moved =
        load_mitsuba_text(sensor("<float name=\"principal_point_offset_x\" value=\"0.1\"/><float "
                                 "name=\"principal_point_offset_y\" value=\"0.2\"/>",
                                 ""));
    CHECK(moved.setting("size") == "640x360");
    CHECK(moved.camera.fov_deg == Approx(60.0f));
    CHECK(moved.camera.shift.x == Approx(64.0f / 360.0f));
    CHECK(moved.camera.shift.y == Approx(-0.2f));
    CHECK_THAT(input_error([&] { load_mitsuba_text(sensor("", "<integer name=\"crop_width\" value=\"641\"/>")); }),
               contains("expected a crop within 640x360 pixels, got 641x360 at (0, 0)"));
}

TEST_CASE("mitsuba: parameters and included files") {
    const TemporaryFolder folder;
    folder.write("parts/wall.xml",
                 scene_of("<bsdf type=\"diffuse\" id=\"wall\"><rgb name=\"reflectance\" value=\"$gray\"/></bsdf>"));
    const SceneDescription scene =
        load_mitsuba_text(folder, "<default name=\"gray\" value=\"0.25\"/><include filename=\"parts/wall.xml\"/>"
                                  "<shape type=\"rectangle\"><ref id=\"wall\"/></shape>");
    CHECK(scene.materials.at(0).albedo == glm::vec3(0.25f));
    REQUIRE(scene.files.size() == 2);
    CHECK(scene.files[1] == folder.path() / "parts/wall.xml");
    folder.write("again.xml", scene_of("<include filename=\"again.xml\"/>"));
    CHECK_THAT(input_error([&] { load_mitsuba_text(folder, "<include filename=\"again.xml\"/>"); }),
               contains("in a circle?"));
}

TEST_CASE("mitsuba: parameters are given from outside, and those that no file has are refused") {
    const TemporaryFolder folder;
    folder.write("wall.xml", scene_of("<default name=\"green\" value=\"0\"/><bsdf type=\"diffuse\" id=\"wall\"><rgb "
                                      "name=\"reflectance\" value=\"$gray $green 0\"/></bsdf>"));
    const auto file = folder.write("s.xml", scene_of("<default name=\"gray\" value=\"0.25\"/>"
                                                     "<default name=\"unused\" value=\"\"/>"
                                                     "<include filename=\"wall.xml\"/><shape type=\"$shape\"><ref "
                                                     "id=\"wall\"/></shape>"));
    using Parameters = std::vector<std::pair<std::string, std::string>>;
    const auto load = [&](const Parameters& given) { return load_scene(file.string(), "", {.parameters = given}); };
    const auto color = [&](const Parameters& given) { return load(given).materials.at(0).albedo; };
    CHECK(color({{"shape", "rectangle"}}) == glm::vec3(0.25f, 0.0f, 0.0f));
    CHECK(color({{"shape", "rectangle"}, {"gray", "0.5"}}) == glm::vec3(0.5f, 0.0f, 0.0f));
    CHECK(color({{"gray", "1"}, {"green", "0.5"}, {"shape", "cube"}, {"gray", "0.75"}, {"unused", "x"}}) ==
          glm::vec3(0.75f, 0.5f, 0.0f));
    const auto complaint = [&](const Parameters& given) {
        try {
            load(given);
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::Usage);
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    CHECK_THAT(
        complaint({{"shape", "rectangle"}, {"grey", "1"}}),
        contains("-D grey: ") &&
            contains("s.xml has no such parameter, did you mean 'gray'? Known are: gray, green, shape, unused"));
    CHECK_THAT(complaint({{"$gray", "1"}}), contains("-D $gray: "));
    CHECK_THAT(input_error([&] { load({{"shape", "rectangle"}, {"gray", "red"}}); }), contains("'red'"));
    const auto plain = folder.write("plain.xml", scene_of(kSquare));
    CHECK_THAT(error_message(ErrorKind::Usage,
                             [&] {
                                 load_scene(plain.string(), "", {.parameters = {{"gray", "1"}}});
                             }),
               contains("plain.xml has no such parameter: it has none"));
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK_THAT(error_message(ErrorKind::Usage,
                             [&] {
                                 load_scene((folder.path() / "m.obj").string(), "", {.parameters = {{"gray", "1"}}});
                             }),
               contains("-D gray: ") && contains("m.obj has no such knob: it has none"));
}

TEST_CASE("mitsuba: ids of objects inside of others, and other names of them") {
    const SceneDescription scene = load_mitsuba_text(
        "<bsdf type=\"twosided\"><bsdf type=\"diffuse\" id=\"wall\"><rgb name=\"reflectance\" "
        "value=\"0.3\"/></bsdf></bsdf><alias id=\"wall\" as=\"paint\"/><shape type=\"rectangle\"><ref "
        "id=\"wall\"/></shape><shape type=\"rectangle\"><ref id=\"paint\"/></shape>");
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].albedo == glm::vec3(0.3f));
}

TEST_CASE("mitsuba: folders in which files are searched, also above that of the scene") {
    const TemporaryFolder folder;
    folder.write("common/q.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("common/b.xml", scene_of("<bsdf type=\"diffuse\" id=\"b\"/>"));
    const std::string content = "<include filename=\"b.xml\"/><shape type=\"obj\"><string name=\"filename\" "
                                "value=\"q.obj\"/><ref id=\"b\"/></shape>";
    const auto load = [&](const std::string& path) {
        const auto file = folder.write("scenes/a/s.xml", scene_of("<path value=\"" + path + "\"/>" + content));
        return load_scene(file.string(), "");
    };
    CHECK(load("../../common").triangles.size() == 1);
    const std::string above = "b.xml";
    CHECK_THAT(input_error([&] { load("../../../../common"); }), contains(above));
    CHECK_THAT(input_error([&] { load((folder.path() / "common").string()); }), contains(above));
    CHECK(is_told(load_mitsuba_text(kSquare + "<path value=\"/etc\"/>"), "folders of 'path' that are absolute"));
}

TEST_CASE("mitsuba: the depth of the integrator is a preset") {
    const auto depth = [](const std::string& integrator) {
        return std::string(load_mitsuba_text(kSquare + integrator).setting("max-depth"));
    };
    const auto path = [](const std::string& value) {
        return "<integrator type=\"path\"><integer name=\"maxDepth\" value=\"" + value +
               "\"/><integer name=\"rrDepth\" value=\"5\"/></integrator>";
    };
    CHECK(depth("<integrator type=\"path\"/>").empty());
    CHECK(depth(path("-1")).empty());
    CHECK(depth(path("2")) == "2");
    CHECK(depth(path("100000")) == "65536");
    CHECK(depth("<integrator type=\"direct\"/>") == "2");
    CHECK(depth("<integrator type=\"aov\">" + path("3") + "</integrator>") == "3");
    CHECK(is_told(load_mitsuba_text(kSquare + "<integrator type=\"ptracer\"/>"),
                  "integrators of the type 'ptracer' are left out"));
    CHECK(is_told(load_mitsuba_text(kSquare + "<integrator type=\"path\"><boolean name=\"hide_emitters\" "
                                              "value=\"true\"/></integrator>"),
                  "'hide_emitters' is left out"));
}

TEST_CASE("mitsuba: properties that nothing asked for are told once for each kind of object") {
    const std::string sphere = "<shape type=\"sphere\"><float name=\"spin\" value=\"1\"/></shape>";
    const SceneDescription scene = load_mitsuba_text(
        sphere + sphere +
        "<bsdf type=\"diffuse\" id=\"not shown\"><float name=\"gloss\" value=\"1\"/></bsdf>"
        "<emitter type=\"projector\"><float name=\"focus\" value=\"1\"/></emitter>"
        "<sensor type=\"perspective\"><sampler type=\"independent\"/><film type=\"hdrfilm\"><rfilter "
        "type=\"box\"/><string name=\"pixel_format\" value=\"rgb\"/><float name=\"exposure\" "
        "value=\"1\"/></film></sensor>");
    CHECK(is_told(scene, "'spin' of shape 'sphere' is not used (2 in all)"));
    CHECK(is_told(scene, "'exposure' of film 'hdrfilm' is not used (1 in all)"));
    CHECK(std::ranges::count_if(scene.warnings, [](const std::string& text) {
              return text.find("is not used") != std::string::npos;
          }) == 2);
    CHECK(is_told(load_mitsuba_text("<shape type=\"rectangle\"><bsdf type=\"roughplastic\"><texture type=\"bitmap\" "
                                    "name=\"alpha\"/></bsdf></shape>"),
                  "'alpha' of bsdf 'roughplastic' is no number, and is not used"));
}

TEST_CASE("mitsuba: without the file of a mesh the rest is shown") {
    const SceneDescription scene =
        load_mitsuba_text(kSquare + "<shape type=\"obj\"><string name=\"filename\" value=\"none.obj\"/></shape>");
    CHECK(scene.triangles.size() == 2);
    CHECK(is_told(scene, "none.obj: its shape is left out"));
}

TEST_CASE("mitsuba: environment maps are turned, tilted and mirrored as their places are") {
    const TemporaryFolder folder;
    write_pfm(folder.path() / "e.pfm", {.width = 2, .height = 1, .pixels = {glm::vec3(1.0f), glm::vec3(2.0f)}});
    const auto map = [&](const std::string& steps) {
        const SceneDescription scene = load_mitsuba_text(
            folder, kSquare +
                        "<emitter type=\"envmap\"><string name=\"filename\" value=\"e.pfm\"/><transform "
                        "name=\"to_world\">" +
                        steps + "</transform></emitter>");
        CHECK(std::ranges::none_of(
            scene.warnings, [](const std::string& text) { return text.find("stretched") != std::string::npos; }));
        return scene.environment_map;
    };
    const auto is_near = [](const glm::mat3& a, const glm::mat3& b) {
        float most = 0.0f;
        for (int i = 0; i < 3; ++i) most = std::max(most, glm::length(a[i] - b[i]));
        return most < 1e-6f;
    };
    const EnvironmentMapDescription upright = map("<rotate y=\"1\" angle=\"30\"/><translate x=\"5\"/>");
    CHECK(upright.axes == glm::mat3(1.0f));
    CHECK(upright.rotation_deg == Approx(210.0f));
    const EnvironmentMapDescription tilted = map("<rotate x=\"1\" angle=\"90\"/><scale value=\"3\"/>");
    CHECK(tilted.rotation_deg == 180.0f);
    CHECK(is_near(tilted.axes, glm::mat3(1, 0, 0, 0, 0, 1, 0, -1, 0)));  // its up is +z
    CHECK(is_near(map("<scale x=\"-1\"/>").axes, glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, 1)));
    CHECK(is_near(map("<scale y=\"-1\"/>").axes, glm::mat3(1, 0, 0, 0, -1, 0, 0, 0, 1)));
    const SceneDescription stretched = load_mitsuba_text(
        folder, kSquare + "<emitter type=\"envmap\"><string name=\"filename\" value=\"e.pfm\"/><transform "
                          "name=\"to_world\"><scale x=\"2\"/></transform></emitter>");
    CHECK(is_told(stretched, "environment maps that are stretched"));
}

TEST_CASE("mitsuba: broken files are refused with file and line", "[hard]") {
    struct Case {
        std::string content;
        std::string told;
    };
    for (const Case& broken : std::vector<Case>{
             {"<shape type=\"rectangle\">", "not valid XML"},
             {"", "expected a shape with an area, got none"},
             {"<shape type=\"rectangle\"><ref id=\"none\"/></shape>",
              "s.xml:2: 'ref': expected the id of an object, got 'none'"},
             {"<shape type=\"obj\"><string name=\"filename\" value=\"../a.obj\"/></shape>",
              "in the folder of the scene"},
             {"<shape type=\"obj\"><string name=\"filename\" value=\"/etc/passwd\"/></shape>",
              "in the folder of the scene"},
             {"<include filename=\"../a.xml\"/>", "in the folder of the scene"},
             {"<shape type=\"rectangle\"><bsdf type=\"diffuse\"><spectrum name=\"reflectance\" "
              "value=\"400:0.1 700:\"/></bsdf></shape>",
              "expected pairs of a wavelength and a value such as 400:0.5, got '700:'"},
             {"<shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape>",
              "expected finite numbers, got 'x'"},
             {"<shape type=\"sphere\"><float name=\"radius\" value=\"1e19\"/></shape>",
              "expected coordinates up to 1e+18"},
             {"<shape type=\"rectangle\"><transform name=\"to_world\"><shear/></transform></shape>",
              "expected translate, scale"},
             {"<shape type=\"rectangle\"><bsdf type=\"twosided\"/></shape>", "expected a surface inside, got none"},
             {"<bsdf type=\"mask\" id=\"a\"><ref id=\"a\"/></bsdf><shape type=\"rectangle\"><ref id=\"a\"/></shape>",
              "got a circle"},
             {kSquare + "<sensor type=\"perspective\"><film type=\"a\"><integer name=\"width\" "
                        "value=\"0\"/></film></sensor>",
              "expected a picture of 1 to 65536 pixels"},
             {kSquare + "<sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor>",
              "within (0, 180) degrees"},
         }) {
        INFO(broken.content);
        CHECK_THAT(refusal(broken.content), contains("s.xml") && contains(broken.told));
    }
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    for (int i = 0; i < 100000; ++i) deep += "</a>";
    CHECK_THAT(refusal(deep), contains("s.xml"));
    // Entities of a document type are not expanded: such a file stays as small as it is.
    const TemporaryFolder folder;
    const auto bomb = folder.write("b.xml", "<!DOCTYPE a [<!ENTITY b \"cccccccccc\"><!ENTITY d \"&b;&b;&b;\">]>\n" +
                                                scene_of("<shape type=\"rectangle\" id=\"&d;\"/>"));
    CHECK(load_scene(bomb.string(), "").triangles.size() == 2);
    CHECK_THAT(input_error([&] { load_scene(folder.write("c.xml", "<svg/>").string(), ""); }),
               contains("expected a scene of Mitsuba"));
}
