// Scenes whose light is known in closed form, through the command line: files in, picture out.
#include <map>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/hard/meshes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/statistics/rules.h"

using namespace pl;
using namespace pl::test;
using nlohmann::json;

namespace {

constexpr double kPrecisePi = 3.14159265358979323846;

struct Rendered {
    LinearImage picture;
    json stats;
};

Rendered render(const TempDir& folder, const std::string& scene, const std::string& options) {
    const ProgramResult result =
        run_shell("pathlight render " + scene + " -o " + (folder / "x.pfm") + " --stats " + (folder / "s.json") +
                  " -q -t 1 --volumes 100 --bins 64 --backend cpu " + options);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return {read_linear(folder / "x.pfm"), json::parse(read_all(folder / "s.json"))};
}

const std::vector<std::string> kWays{"--method default", "--method default --nee on", "--method precomputed",
                                     "--method reinforcement", "--method reinforcement --nee on"};
const std::vector<std::string> kLightWays{"--method default --nee on", "--method reinforcement --nee on"};

/// Rule S1 with the pixels as samples: they show the same point with independent random numbers.
Decision mean_of(const LinearImage& picture, Reference reference, double delta, int channel = 1) {
    Moments pixels;
    for (const glm::vec3& pixel : picture.pixels) pixels.add(static_cast<double>(pixel[channel]));
    return mean_equals(pixels, reference, delta);
}

double worst_of(const LinearImage& picture, double expected) {
    double worst = 0.0;
    for (const glm::vec3& pixel : picture.pixels)
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(static_cast<double>(pixel[c]) - expected));
    return worst;
}

void check_mean(const TempDir& folder, const std::string& scene, const std::vector<std::string>& ways,
                const std::string& options, Reference reference, double delta) {
    for (const std::string& way : ways) {
        INFO(way);
        const Rendered rendered = render(folder, scene, "--size 64x64 " + way + " " + options);
        CHECK(mean_of(rendered.picture, reference, delta));
        CHECK(rendered.stats.at("invalid_samples") == 0);
    }
}

/// A lamp over or beside a gray floor z = 0, seen at a point.
MeshFile floor_mesh() {
    MeshFile mesh;
    mesh.material("floor", "Kd 0.6 0.6 0.6");
    mesh.material("lamp", "Kd 0 0 0\nKe 1 1 1");
    mesh.face("floor", {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
    return mesh;
}

}  // namespace

TEST_CASE("R1 R2 the furnace: e over 1 less rho, and its sum when paths are cut", "[hard][R1][R2]") {
    const TempDir folder;
    check_mean(folder, "furnace", kWays, "--spp 32", {1.0}, 0.01);
    const Rendered cut = render(folder, "furnace", "--nee off --size 128x128 --spp 1 --max-depth 3");
    CHECK(within(worst_of(cut.picture, 1.0 - 0.125), 16.0 * 0x1p-24));
}

TEST_CASE("R3 a room in equilibrium is evenly bright, whatever its colors", "[hard][R3]") {
    const TempDir folder;
    MeshFile mesh;
    mesh.material("a", "Kd 0.9 0.2 0.5\nKe 0.1 0.8 0.5");
    mesh.material("b", "Kd 0.3 0.7 0\nKe 0.7 0.3 1");
    mesh.room({"a", "b", "a", "b", "b", "a"});
    const std::string scene = mesh.write(folder, "room", looking({0.4, 0.5, 0.6}, {0.1, 0.2, 0.0}, 90));
    for (const std::string& way : kWays) {
        const Rendered rendered = render(folder, scene, "--size 64x64 --spp 16 " + way);
        INFO(way);
        for (int channel = 0; channel < 3; ++channel) CHECK(mean_of(rendered.picture, {1.0}, 0.02, channel));
        CHECK(rendered.stats.at("escaped_paths") == 0);
    }
}

// The transfer between any two places in a sphere is the same: facets of 3.75 degrees are 0.05 % less.
TEST_CASE("R5 inside a sphere of three belts every belt has its closed form", "[hard][R5]") {
    const TempDir folder;
    MeshFile mesh;
    mesh.material("cap", "Kd 0.2 0.2 0.2\nKe 1 1 1");
    mesh.material("middle", "Kd 0.5 0.5 0.5");
    mesh.material("low", "Kd 0.9 0.9 0.9");
    constexpr int kRings = 60;
    // Belts end where rings do: shares of the area are differences of cosines.
    const double upper = std::cos(kPrecisePi * 18 / kRings);
    const double lower = std::cos(kPrecisePi * 36 / kRings);
    mesh.sphere({0, 0, 0}, 1.0, kRings, true,
                [&](double z) { return z > upper ? "cap" : (z < lower ? "low" : "middle"); });
    const double cap = (1.0 - upper) / 2.0;
    const double low = (1.0 + lower) / 2.0;
    const double h = cap / (1.0 - (0.2 * cap + 0.9 * low + 0.5 * (1.0 - cap - low)));
    const std::map<std::string, std::pair<Point, double>> belts{{"cap", {{0.1, 0.05, 0.99}, 1.0 + 0.2 * h}},
                                                                {"middle", {{0.99, 0.1, 0.05}, 0.5 * h}},
                                                                {"low", {{0.1, 0.3, -0.9}, 0.9 * h}}};
    for (const auto& [name, belt] : belts) {
        const std::string scene = mesh.write(folder, "sphere", looking({0.0, 0.0, 0.0}, belt.first));
        INFO(name);
        check_mean(folder, scene, {kWays[1], kWays[3]}, "--spp 16", {belt.second, 3e-3 * belt.second}, 0.04);
    }
}

TEST_CASE("R6 R7 R8 rectangles over and beside a floor have their form factors", "[hard][R6][R7][R8]") {
    const TempDir folder;
    MeshFile over = floor_mesh();
    over.face("lamp", {{-0.4, -0.3, 0.5}, {-0.4, 0.3, 0.5}, {0.8, 0.3, 0.5}, {0.8, -0.3, 0.5}});
    double factor = 0.0;
    for (const double x : {-0.5, 0.7})
        for (const double y : {-0.35, 0.25})
            factor += (x > 0.0 ? 1.0 : -1.0) * (y > 0.0 ? 1.0 : -1.0) * parallel_corner_factor(x, y, 0.5);
    check_mean(folder, over.write(folder, "over", looking({0.4, 0.3, 0.3}, {0.1, 0.05, 0.0})), kWays, "--spp 64",
               {0.6 * factor, 1e-6}, 0.03);

    MeshFile beside = floor_mesh();
    beside.face("lamp", {{-0.5, 0, 0}, {-0.5, 0, 0.8}, {0.7, 0, 0.8}, {0.7, 0, 0}});
    const double side = perpendicular_corner_factor(0.8, 0.6, 0.3) - perpendicular_corner_factor(0.8, -0.6, 0.3);
    check_mean(folder, beside.write(folder, "beside", looking({0.3, 0.7, 0.4}, {0.1, 0.3, 0.0})), kLightWays,
               "--spp 32", {0.6 * side, 1e-5}, 0.02);
}

// 256 sides: their area is 0.01 % less than the disc's.
TEST_CASE("R9 a disc aside gives its form factor", "[hard][R9]") {
    const TempDir folder;
    constexpr double kRadius = 0.4;
    constexpr double kHeight = 0.5;
    constexpr double kAside = 0.6;
    MeshFile mesh = floor_mesh();
    std::vector<Point> rim;
    for (int i = 0; i < 256; ++i)
        rim.push_back({kRadius * std::cos(kPrecisePi * i / 128), -kRadius * std::sin(kPrecisePi * i / 128), kHeight});
    mesh.face("lamp", rim);
    const double h2 = kHeight * kHeight;
    const double o2 = kAside * kAside;
    const double r2 = kRadius * kRadius;
    const double factor = 0.5 * (1.0 - (h2 + o2 - r2) / std::sqrt((h2 + o2 + r2) * (h2 + o2 + r2) - 4.0 * o2 * r2));
    check_mean(folder, mesh.write(folder, "disc", looking({1.0, 0.3, 0.3}, {kAside, 0.0, 0.0})), kLightWays,
               "--spp 32", {0.6 * factor, 3e-4 * factor}, 0.02);
}

// 60 rings: the mesh is 0.07 % narrower than its sphere.
TEST_CASE("R10 a round lamp gives the cosine times the square of its angle", "[hard][R10]") {
    const TempDir folder;
    MeshFile mesh = floor_mesh();
    mesh.sphere({0.6, 0.2, 0.8}, 0.25, 60, false, [](double) { return "lamp"; });
    const double d2 = 0.6 * 0.6 + 0.2 * 0.2 + 0.8 * 0.8;
    const double factor = 0.8 / std::sqrt(d2) * 0.25 * 0.25 / d2;
    check_mean(folder, mesh.write(folder, "ball", looking({-0.5, 0.3, 0.4}, {0, 0, 0})), kLightWays, "--spp 64",
               {0.6 * factor, 3e-3 * factor}, 0.03);
}

TEST_CASE("R11 R12 a floor under an even and a linear sky, and clear glass that cannot be seen", "[hard][R11][R12]") {
    const TempDir folder;
    MeshFile floor;
    floor.material("floor", "Kd 0.6 0.6 0.6");
    floor.face("floor", {{-1e4, 0, 1e4}, {1e4, 0, 1e4}, {1e4, 0, -1e4}, {-1e4, 0, -1e4}});
    const std::string camera = R"("camera": {"eye": [0, 1, 0], "target": [0, 0, 0], "up": [0, 0, -1]}, )";
    // Zero variance by cosine sampling; one product is rounded.
    check_mean(folder, floor.write(folder, "even", camera + R"("environment": {"radiance": [1, 1, 1]})"), kWays,
               "--spp 4", {0.6, 4.0 * 0x1p-24}, 0.01);
    LinearImage sky{.width = 64, .height = 128, .pixels = {}};
    for (int row = 0; row < 128; ++row)
        sky.pixels.insert(sky.pixels.end(), 64,
                          glm::vec3(static_cast<float>(1.0 + 0.5 * std::cos(kPrecisePi * (row + 0.5) / 128.0))));
    write_pfm(folder / "sky.pfm", sky);
    check_mean(folder,
               floor.write(folder, "linear", camera + R"("environment": {"map": "sky.pfm", "rotation_deg": 30})"),
               kWays, "--spp 16", {0.6 * (1.0 + 0.5 * 2.0 / 3.0), 1e-4}, 0.015);

    MeshFile glass;
    glass.material("glass", "Pl_surface dielectric\nNi 1.5");
    glass.sphere({0, 0, 0}, 1.0, 20, false, [](double) { return "glass"; });
    const std::string scene = glass.write(
        folder, "glass", looking({3, 1, 1}, {0, 0, 0}, 50) + R"(, "environment": {"radiance": [1, 1, 1]})");
    CHECK(within(worst_of(render(folder, scene, "--size 64x64 --spp 4 --nee on --max-depth 65536").picture, 1.0),
                 1e-4));
}

// Rays at right angles: every bounce between the two faces counts.
TEST_CASE("R14 a slab of glass passes one less R over one and R", "[hard][R14]") {
    for (const double n : {1.33, 1.5, 2.4}) {
        const TempDir folder;
        MeshFile mesh;
        std::ostringstream glass;
        glass << "Pl_surface dielectric\nNi " << n;
        mesh.material("glass", glass.str());
        mesh.material("lamp", "Kd 0 0 0\nKe 1 1 1");
        mesh.face("glass", {{-5, -5, 1}, {5, -5, 1}, {5, 5, 1}, {-5, 5, 1}});
        mesh.face("glass", {{-5, -5, 0.9}, {-5, 5, 0.9}, {5, 5, 0.9}, {5, -5, 0.9}});
        mesh.face("lamp", {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}});
        const double r = std::pow((n - 1.0) / (n + 1.0), 2.0);
        const std::string scene =
            mesh.write(folder, "slab", R"("camera": {"eye": [0.1, 0.2, 3], "target": [0.1, 0.2, 0],
            "up": [0, 1, 0], "fov_deg": 0.05})");
        INFO("index " << n);
        check_mean(folder, scene, {kWays[0], kWays[1]}, "--spp 64", {(1.0 - r) / (1.0 + r), 1e-5}, 0.02);
    }
}

TEST_CASE("R15 R16 plates between mirrors are as bright as if they were infinite", "[hard][R15][R16]") {
    const TempDir folder;
    MeshFile mesh;
    mesh.material("mirror", "Pl_surface conductor\nPl_roughness 0\nKs 1 1 1");
    mesh.material("floor", "Kd 0.7 0.7 0.7\nKe 1 1 1");
    mesh.material("ceiling", "Kd 0.4 0.4 0.4\nKe 0.25 0.25 0.25");
    mesh.room({"mirror", "mirror", "floor", "ceiling", "mirror", "mirror"});
    const std::string floor = mesh.write(folder, "plates", looking({0.5, 0.5, 0.5}, {0.5, 0.0, 0.5}, 30));
    check_mean(folder, floor, kWays, "--spp 32 --max-depth 10000", {(1.0 + 0.7 * 0.25) / (1.0 - 0.7 * 0.4)}, 0.02);
    const std::string ceiling = mesh.write(folder, "plates", looking({0.5, 0.5, 0.5}, {0.5, 1.0, 0.5}, 30));
    check_mean(folder, ceiling, {kWays[0], kWays[3]}, "--spp 48 --max-depth 10000",
               {(0.25 + 0.4 * 1.0) / (1.0 - 0.7 * 0.4)}, 0.02);
}

// Centers of the floor; solved by collocation with 6 x 64 x 64 patches, good to 1e-5.
TEST_CASE("R18 a cube under a bright ceiling has the solved radiosity at the floor", "[hard][R18]") {
    const TempDir folder;
    for (const bool colored : {false, true}) {
        MeshFile mesh;
        mesh.material("white", colored ? "Kd 0.75 0.75 0.75" : "Kd 0.5 0.5 0.5");
        mesh.material("red", colored ? "Kd 0.63 0.63 0.63" : "Kd 0.5 0.5 0.5");
        mesh.material("green", colored ? "Kd 0.14 0.14 0.14" : "Kd 0.5 0.5 0.5");
        mesh.material("ceiling", std::string(colored ? "Kd 0.75 0.75 0.75" : "Kd 0.5 0.5 0.5") + "\nKe 1 1 1");
        mesh.room({"red", "green", "white", "ceiling", "white", "white"});
        const std::string scene = mesh.write(folder, "cube", looking({0.5, 0.5, 0.5}, {0.5, 0.0, 0.5}));
        INFO((colored ? "three albedos" : "albedo one half"));
        check_mean(folder, scene, kWays, "--spp 32", {colored ? 0.36203 : 0.19760, 1e-5}, 0.05);
    }
}

TEST_CASE("R22 L17 a lamp, and a lamp in a mirror, are as bright as they are", "[hard][R22][L17]") {
    const TempDir folder;
    MeshFile lamp;
    lamp.material("lamp", "Kd 0 0 0\nKe 17 12.1 4.3");
    lamp.face("lamp", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    const std::string direct = lamp.write(folder, "lamp", looking({0.1, 0.2, 1}, {0, 0, 0}));
    for (const glm::vec3& pixel : render(folder, direct, "--size 32x32 --spp 5").picture.pixels)
        REQUIRE(pixel == glm::vec3(17.0f, 12.1f, 4.3f));

    MeshFile mirror;
    mirror.material("lamp", "Kd 0 0 0\nKe 3 3 3");
    mirror.material("mirror", "Pl_surface conductor\nPl_roughness 0\nKs 1 1 1");
    mirror.face("lamp", {{-9, -9, 2}, {-9, 9, 2}, {9, 9, 2}, {9, -9, 2}});
    mirror.face("mirror", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    const std::string reflected = mirror.write(folder, "mirror", looking({0.1, 0.2, 1}, {0, 0, 0}));
    for (const std::string& way : kWays) {
        INFO(way);
        CHECK(within(worst_of(render(folder, reflected, "--size 32x32 --spp 5 " + way).picture, 3.0), 3e-6));
    }
}
