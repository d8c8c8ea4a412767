// Golden pictures: displays over the picture, drawn by the code of the window into memory. Data are made by hand, so that no bit of a
// rendering decides them. Equal but for 0.2 % of the pixels, which edges may move to another side of a pixel's middle by rounding.
// A picture that differs is written to the folder "pathlight-pictures" for temporary files, to be looked at; if it is right, it
// replaces the golden one in tests/ui/pictures.
#include "ui/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "ui/draw/style.h"
#include "ui/window/offscreen.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

namespace fs = std::filesystem;

constexpr int kPictureWidth = 240;
constexpr int kPictureHeight = 180;
constexpr int kVolumeSide = 8;

const fs::path kFolder = fs::path(PL_SOURCE_DIR) / "tests" / "ui" / "pictures";
const fs::path kFont = fs::path(PL_SOURCE_DIR) / "assets" / "fonts" / "roboto-medium-latin.ttf";

double share_that_differs(const ByteImage& a, const ByteImage& b) {
    if (a.width != b.width || a.height != b.height) return 1.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int most = 0;
        for (std::size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(int{a.rgb[c]} - int{b.rgb[c]}));
        count += most > 12 ? 1 : 0;
    }
    return 3.0 * static_cast<double>(count) / static_cast<double>(a.rgb.size());
}

void check_golden(const ByteImage& image, const std::string& name) {
    const fs::path golden = kFolder / name;
    const double differs = fs::exists(golden) ? share_that_differs(image, read_png8(golden)) : 1.0;
    INFO(name << ": " << 100.0 * differs << " % of the pixels differ");
    if (differs > 0.002) {
        const fs::path folder = fs::temp_directory_path() / "pathlight-pictures";
        fs::create_directories(folder);
        write_png8(folder / name, image);
    }
    CHECK(differs <= 0.002);
}

/// A gray picture of the small scene.
struct GrayFrame {
    std::vector<std::uint32_t> gray = std::vector<std::uint32_t>(kPictureWidth * kPictureHeight, 0xff404448u);
    PublishedFrame frame;

    GrayFrame() {
        frame.description = small_scene();
        frame.scene = std::make_shared<const HostScene>(pack_scene(*frame.description));
        frame.facts = facts_of(*frame.description);
        frame.snapshot.width = kPictureWidth;
        frame.snapshot.height = kPictureHeight;
        frame.snapshot.camera = frame.description->camera;
        frame.snapshot.camera.fov_deg = 16.0f;  // shapes are large in the picture
        frame.picture = {.width = kPictureWidth, .height = kPictureHeight, .pixels = [this] { return gray.data(); }};
    }
    GrayFrame(const GrayFrame&) = delete;
    GrayFrame& operator=(const GrayFrame&) = delete;

    /// A point that the camera sees in this place of the picture, in [0, 1]^2, at this share of the distance to its target.
    Vec3f seen_at(Vec2f point, float share) const {
        const CameraDescription& camera = frame.snapshot.camera;
        const Ray ray = generate_ray(make_camera(camera, kPictureWidth, kPictureHeight),
                                     point * Vec2f(kPictureWidth, kPictureHeight),
                                     {static_cast<float>(kPictureWidth), static_cast<float>(kPictureHeight)});
        const float distance = glm::length(camera.target - camera.eye);
        return camera.eye + share * distance * glm::normalize(ray.direction);
    }
};

/// Dim light but for a block of 4 x 4 cells from one on.
std::shared_ptr<const VolumeInspection> volume_at(Vec3f position, Vec3f normal, std::size_t bright) {
    auto volume = std::make_shared<VolumeInspection>();
    volume->volume = static_cast<std::int32_t>(bright);
    volume->position = position;
    volume->normal = normal;
    volume->side = kVolumeSide;
    volume->radiance.assign(kVolumeSide * kVolumeSide, 4.0f);
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            volume->radiance[(bright + row * kVolumeSide + column) % (kVolumeSide * kVolumeSide)] = 20.0f;
    float total = 0.0f;
    for (const float q : volume->radiance) total += q;
    for (const float q : volume->radiance) volume->probability.push_back(q / total);
    const int points = kVolumeSide * kFinePoints;
    for (int i = 0; i < points * points; ++i) {
        const int cell = (i / points / kFinePoints) * kVolumeSide + i % points / kFinePoints;
        volume->density.push_back(volume->probability[static_cast<std::size_t>(cell)] * kVolumeSide * kVolumeSide);
    }
    return volume;
}

}  // namespace

TEST_CASE("Pictures: two pinned volumes as lobes, and one as a glass dome") {
    const GrayFrame gray;
    const PicturePainter painter(kFont);
    const Vec3f up = glm::normalize(gray.frame.snapshot.camera.up);
    const auto first = volume_at(gray.seen_at({0.3f, 0.6f}, 0.5f), up, 12);
    const auto second = volume_at(gray.seen_at({0.7f, 0.5f}, 0.5f), up, 51);
    check_golden(painter.volumes(gray.frame, {first, second}, LobeShape::Lobe), "pinned-lobes.png");
    check_golden(painter.volumes(gray.frame, {first}, LobeShape::Dome), "dome.png");
}

TEST_CASE("Pictures: lobes of every volume of a field") {
    GrayFrame gray;
    SessionBench bench;
    bench.render(kLearning, 1);
    FieldHistoryRecorder recorder;
    recorder.set_limit(std::size_t{1} << 20);
    REQUIRE(recorder.observe(bench.session, MethodId::Reinforcement));
    check_golden(PicturePainter(kFont).flowers(gray.frame, *recorder.history()->frames.back()), "flowers.png");
}

TEST_CASE("Pictures: two paths as lines, the brighter one wide and numbered") {
    const GrayFrame gray;
    diagnose::PixelPaths paths;
    for (const float light : {0.1f, 2.0f}) {
        diagnose::PathRecord path;
        path.radiance = Vec3f(light);
        path.eye = gray.frame.snapshot.camera.eye;
        for (const Vec2f point : {Vec2f{0.5f, 0.6f}, Vec2f{0.2f + 0.2f * light, 0.3f}, Vec2f{0.8f, 0.4f}}) {
            diagnose::VertexRecord vertex;
            vertex.origin = path.vertices.empty() ? path.eye : path.vertices.back().position;
            vertex.position = gray.seen_at(point, 0.5f);
            path.vertices.push_back(vertex);
        }
        paths.plain.push_back(path);
    }
    check_golden(PicturePainter(kFont).paths(gray.frame, paths), "paths.png");
}

TEST_CASE("Pictures: divergences and variance factor over the passes") {
    std::vector<FigurePoint> points;
    for (const std::uint64_t passes : {1u, 2u, 4u, 8u, 16u}) {
        const double value = 1.0 / static_cast<double>(passes);
        points.push_back({passes,
                          {.table = {value, 0.9 * value, 1.1 * value},
                           .mixture = {0.5 * value, 0.4 * value, 0.6 * value},
                           .variance_factor = Interval{0.2 + value, 0.1 + value, 0.3 + value}}});
    }
    check_golden(PicturePainter(kFont).figures(points, 420, 240), "figures.png");
}

TEST_CASE("Offscreen: the background is kept to the bit, and text has the window's font") {
    std::vector<std::uint32_t> background(64 * 32);
    for (std::size_t i = 0; i < background.size(); ++i)
        background[i] = 0xff000000u | static_cast<std::uint32_t>(i * 7919u);
    Offscreen offscreen(64, 32, kFont);
    const ByteImage plain = offscreen.paint(background.data(), [] {});
    REQUIRE(plain.rgb.size() == 3 * background.size());
    for (std::size_t i = 0; i < background.size(); ++i) {
        const std::uint32_t pixel = plain.rgb[3 * i] * 65536u + plain.rgb[3 * i + 1] * 256u + plain.rgb[3 * i + 2];
        CHECK(pixel == (background[i] & 0xffffffu));
    }
    const ByteImage text = offscreen.paint(nullptr, [] {
        CHECK(ImGui::GetFontSize() == kFontPixels);
        CHECK(ImGui::CalcTextSize("W").x > ImGui::CalcTextSize("i").x + 2.0f);  // the built-in font has equal letters
        ImGui::GetForegroundDrawList()->AddText({4.0f, 4.0f}, IM_COL32_WHITE, "light");
    });
    CHECK(*std::ranges::max_element(text.rgb) > 200);
}
