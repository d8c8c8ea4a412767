// glTF files from a shell: a file and its OBJ twin show the same picture, to the bit; cameras are listed and chosen.
#include <nlohmann/json.hpp>

#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/gltf_maker.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

/// A material of nothing but Lambert reflection and emission.
Json matte(const MaterialDescription& material) {
    constexpr float kStrength = 32.0f;  // a power of two: divides without rounding
    const auto color = [](const glm::vec3& v) { return Json{v.x, v.y, v.z}; };
    Json base = color(material.albedo);
    base.push_back(1);
    return {{"name", material.name},
            {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0}}},
            {"emissiveFactor", color(material.emission / kStrength)},
            {"extensions",
             {{"KHR_materials_specular", {{"specularFactor", 0}}},
              {"KHR_materials_emissive_strength", {{"emissiveStrength", kStrength}}}}}};
}

/// The scene as one mesh, with a primitive for each run of triangles of a material.
std::string twin_of(const SceneDescription& scene) {
    GltfMaker file;
    for (const MaterialDescription& material : scene.materials) file.root["materials"].push_back(matte(material));
    const std::vector<glm::vec3>& corners = scene.positions;
    const int positions = file.accessor({{"bufferView", file.view(bytes_of(corners))},
                                         {"componentType", 5126},
                                         {"type", "VEC3"},
                                         {"count", corners.size()}});
    Json primitives = Json::array();
    for (std::size_t i = 0; i < scene.triangles.size();) {
        const std::uint32_t material = scene.triangles[i].material;
        std::vector<std::uint16_t> indices;
        for (; i < scene.triangles.size() && scene.triangles[i].material == material; ++i)
            for (int k = 0; k < 3; ++k) indices.push_back(static_cast<std::uint16_t>(scene.triangles[i].vertex[k]));
        primitives.push_back(
            {{"attributes", {{"POSITION", positions}}}, {"indices", file.indices(indices)}, {"material", material}});
    }
    file.root["meshes"] = {{{"primitives", primitives}}};
    file.node({{"mesh", 0}});
    return file.glb();
}

}  // namespace

TEST_CASE("gltf: the Cornell box has the picture of its OBJ file, to the bit") {
    const TempDir folder;
    write_all(folder / "box.glb", twin_of(load_scene("cornell", find_assets_dir())));
    const auto picture = [&](const std::string& scene) {
        const std::string file = folder / "a.pfm";
        const ProgramResult result =
            run_program({"render", scene, "-o", file, "--size", "32x32", "--spp", "4", "--eye", "278,273,-800",
                         "--target", "278,273,0", "--fov", "39.3077", "--nee", "on", "-q"});
        REQUIRE(result.code == 0);
        CHECK(result.err.empty());
        return read_all(file);
    };
    const std::string own = picture("cornell");
    CHECK(own.size() > 32 * 32 * 12);
    CHECK(picture(folder / "box.glb") == own);
}

TEST_CASE("gltf: cameras are listed by info and chosen by --camera") {
    GltfMaker file;
    file.triangle();
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}}}}};
    file.node({{"name", "front"}, {"camera", 0}, {"translation", {0, 0, 5}}});
    file.node({{"name", "far"}, {"camera", 0}, {"translation", {0, 0, 9}}});
    const TempDir folder;
    write_all(folder / "a.gltf", file.text());
    const auto info = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"info", folder / "a.gltf", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ordered_json::parse(lines_of(run_program(arguments).out).back());
    };
    CHECK(info({})["cameras"] == ordered_json::array({"front", "far"}));
    CHECK(info({})["camera"]["eye"] == ordered_json::array({0.0, 0.0, 5.0}));
    CHECK(info({"--camera", "far"})["camera"]["eye"] == ordered_json::array({0.0, 0.0, 9.0}));
    CHECK_THAT(run_program({"info", folder / "a.gltf", "--camera", "2"}).out,
               contains("--camera 1: front\n") && contains("--camera 2: far (this one)"));
    const ProgramResult wrong = run_program({"info", folder / "a.gltf", "--camera", "3"});
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err,
               contains("--camera 3: expected a camera .json file, or one of the cameras") && contains("2 'far'"));
}

}  // namespace pl::test
