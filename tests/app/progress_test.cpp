// The parts of the program that are worth a test of their own.
#include <algorithm>
#include <csignal>
#include <random>

#include <sys/wait.h>
#include <unistd.h>

#include "app/canvas.h"
#include "app/closest_surface.h"
#include "app/draw_hemisphere.h"
#include "app/events.h"
#include "app/interrupt.h"
#include "app/picture_file.h"
#include "app/progress.h"
#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl {
namespace {

using test::TempDir;

SceneDescription one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    SceneDescription scene;
    scene.positions = {a, b, c};
    scene.materials.emplace_back();
    scene.triangles.push_back({.vertex = {0, 1, 2}});
    return scene;
}

/// Exit code of a child process that runs `body`.
template <class Body>
int in_child(Body body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

Snapshot tiny_picture(View view, const std::vector<Vec3f>& pixels) {
    Snapshot snapshot;
    snapshot.slot.view = view;
    snapshot.width = static_cast<int>(pixels.size());
    snapshot.height = 1;
    snapshot.pixels = pixels;
    return snapshot;
}

}  // namespace

TEST_CASE("the first interruption raises the flag, the second one ends the program with 130") {
    CHECK(in_child([] {
              const InterruptGuard guard;
              raise(SIGINT);
              _exit(guard.raised() ? 7 : 8);
          }) == 7);
    CHECK(in_child([] {
              const InterruptGuard guard;
              raise(SIGINT);
              raise(SIGINT);
          }) == 130);
    CHECK(in_child([] {
              { const InterruptGuard guard; }
              raise(SIGINT);
          }) == 128 + SIGINT);
    CHECK(in_child([] {
              const InterruptGuard guard;
              raise(SIGTERM);
              _exit(guard.raised() ? 7 : 8);
          }) == 7);
}

TEST_CASE("the closest surface point is the closest of a dense set of points") {
    // The sampled triangle has points every 1/200 of its edges, so that the true distance is at most half a step of the
    // longest edge (3 * sqrt(2) / 200 / 2) below the sampled one, and never above it.
    std::mt19937 random(11);
    std::uniform_real_distribution<float> coordinate(-2.0f, 2.0f);
    const glm::vec3 a(0, 0, 0), b(3, 0, 0), c(0, 3, 1);
    const SceneDescription scene = one_triangle(a, b, c);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 point(coordinate(random), coordinate(random), coordinate(random));
        float sampled = 1.0e9f;
        for (int u = 0; u <= 200; ++u)
            for (int v = 0; u + v <= 200; ++v)
                sampled = std::min(sampled, glm::distance(point, a + (b - a) * (static_cast<float>(u) / 200.0f) +
                                                                     (c - a) * (static_cast<float>(v) / 200.0f)));
        const ClosestSurface surface = closest_surface(scene, point);
        REQUIRE(surface.distance <= sampled + 1.0e-5f);  // rounding of the sampled distance
        REQUIRE(surface.distance >= sampled - 0.0108f);
        REQUIRE(glm::distance(point, surface.position) == Approx(surface.distance).margin(1.0e-5));
        REQUIRE(glm::dot(point - a, surface.normal) >= 0.0f);
    }
}

TEST_CASE("the side of the closest surface is the one that the point lies on") {
    const SceneDescription scene = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    CHECK(closest_surface(scene, {0.2f, 0.2f, 5.0f}).normal.z == 1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, -5.0f}).normal.z == -1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, 0.0f}).normal.z == 1.0f);
    CHECK(closest_surface(scene, {0.2f, 0.2f, 5.0f}).distance == 5.0f);
}

TEST_CASE("a progress bar fits its line and is as full as its share") {
    CHECK(progress_bar(0.5, "text", 27) == "[##########          ] text");
    CHECK(progress_bar(0.0, "text", 17) == "[          ] text");
    CHECK(progress_bar(1.0, "text", 17) == "[##########] text");
    CHECK(progress_bar(0.5, "a long text", 5) == "a lon");
    CHECK(progress_bar(0.5, "text", -1).empty());
    for (int width = 0; width < 120; ++width)
        CHECK(progress_bar(0.3, "rendering", width).size() <= static_cast<std::size_t>(width));
}

TEST_CASE("one message is due in every interval, and none before the end of the first") {
    MessagePace pace(5.0);
    CHECK_FALSE(pace.is_due(0.0));
    CHECK_FALSE(pace.is_due(4.9));
    CHECK(pace.is_due(5.5));
    CHECK_FALSE(pace.is_due(10.4));
    CHECK(pace.is_due(10.5));
    CHECK(pace.is_due(100.0));
    CHECK_FALSE(pace.is_due(104.9));
}

TEST_CASE("durations read well") {
    CHECK(duration_text(0.2) == "1 s");
    CHECK(duration_text(59.0) == "59 s");
    CHECK(duration_text(61.0) == "1:01 min");
    CHECK(duration_text(3600.0 * 2 + 60 * 5) == "2:05 h");
}

TEST_CASE("an event is one line, whatever the text in it") {
    const std::string line = event_line("test", {{"message", "two\nlines \xff"}, {"number", std::nan("")}});
    CHECK(std::count(line.begin(), line.end(), '\n') == 1);
    const Json back = Json::parse(line);
    CHECK(back["schema"] == "pathlight.event/1");
    CHECK(back["event"] == "test");
    CHECK(back["number"].is_null());
}

TEST_CASE("exposure and tone curve apply to radiance, not to data") {
    const Vec3f half(0.25f);
    const DisplaySettings display{.exposure_ev = 1.0f, .curve = ToneCurve::Reinhard};
    // 0.25 * 2 / (1 + 0.5) = 1/3; sRGB of 1/3 and 1/4 from the standard's formula.
    CHECK(int{display_image(tiny_picture(View::Beauty, {half}), display).rgb[0]} == 156);
    CHECK(int{display_image(tiny_picture(View::Normal, {half}), display).rgb[0]} == 137);
    CHECK(int{display_image(tiny_picture(View::Depth, {Vec3f{10.0f}, Vec3f{40.0f}}), display).rgb[0]} == 137);
    const ByteImage invalid = display_image(tiny_picture(View::Beauty, {Vec3f{std::nanf("")}}), display);
    CHECK((invalid.rgb == std::vector<std::uint8_t>{255, 0, 255}));
}

TEST_CASE("heat maps are shown in their colors, whatever the exposure") {
    const DisplaySettings display{.exposure_ev = 3.0f, .curve = ToneCurve::Reinhard};
    const ByteImage image =
        display_image(tiny_picture(View::Visits, {Vec3f{0.0f}, Vec3f{20.0f}, Vec3f{10.0f}}), display);
    CHECK((image.rgb == std::vector<std::uint8_t>{43, 23, 81, 248, 235, 122, 7, 140, 147}));
    const ByteImage share = display_image(tiny_picture(View::Unvisited, {Vec3f{0.5f}}), display);
    CHECK((share.rgb == std::vector<std::uint8_t>{7, 140, 147}));
}

TEST_CASE("a file that cannot be written is found out beforehand, without a trace") {
    const TempDir folder;
    test::write_all(folder / "old.png", "old");
    CHECK_NOTHROW(require_writable(folder / "new.png"));
    CHECK_NOTHROW(require_writable(folder / "old.png"));
    CHECK((folder.names() == std::vector<std::string>{"old.png"}));
    CHECK(test::read_all(folder / "old.png") == "old");
    CHECK_NOTHROW(require_writable("/dev/null"));
    for (const std::string& path : {folder / "missing/new.png", folder.path().string(), folder / "old.png/x.png"}) {
        try {
            require_writable(path);
            FAIL(path << " counts as writable");
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::Runtime);
            CHECK_THAT(error.what(), test::contains(path));
        }
    }
}

TEST_CASE("text is drawn where it is put, and what lies outside is cut off") {
    Canvas canvas(20, 10, {0, 0, 0});
    canvas.text(1, 1, "I", {255, 255, 255}, 1);
    const auto lit = [&](int x, int y) {
        return canvas.image().rgb[3 * static_cast<std::size_t>(y * 20 + x)] == 255;
    };
    CHECK(lit(3, 1));
    CHECK(lit(3, 7));
    CHECK_FALSE(lit(1, 4));
    CHECK_NOTHROW(canvas.text(-100, 5, "off", {1, 2, 3}));
    CHECK_NOTHROW(canvas.fill(18, 8, 100, 100, {1, 2, 3}));
}

TEST_CASE("the drawn disc shows each cell where its directions are") {
    VolumeInspection volume;
    volume.normal = {0, 0, 1};
    volume.side = 4;
    volume.radiance.assign(16, 0.0f);
    volume.probability.assign(16, 1.0f / 16.0f);
    volume.visits.assign(16, 1);
    volume.radiance[15] = 1.0f;  // highest row and column: towards +x, +y
    const ByteImage image = draw_hemisphere(volume, "test");
    const Rgb bright = share_color(1.0f);
    const auto color_at = [&](int x, int y) {
        const std::size_t i = 3 * static_cast<std::size_t>(y * image.width + x);
        return Rgb{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
    };
    // The large disc: upper left corner (24, 180), diameter 520.
    const int center_x = 24 + 260, center_y = 180 + 260, off = 170;
    CHECK(color_at(center_x + off, center_y - off) == bright);
    CHECK(color_at(center_x - off, center_y - off) == share_color(0.0f));
    CHECK(color_at(center_x + off, center_y + off) == share_color(0.0f));
    CHECK(color_at(center_x, center_y) == share_color(0.0f));
}

}  // namespace pl
