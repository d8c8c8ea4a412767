// Paths of the camera: through their cameras to the bit, smooth between them, level.
#include "core/scene/camera_path.h"

#include <cmath>

#include "core/base/error.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

CameraDescription camera(glm::vec3 eye, glm::vec3 target) {
    CameraDescription made;
    made.eye = eye;
    made.target = target;
    return made;
}

/// Once around the origin, looking at it.
std::vector<CameraDescription> circle(int count) {
    std::vector<CameraDescription> cameras;
    for (int i = 0; i < count; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count);
        cameras.push_back(camera({4.0f * std::sin(angle), 1.0f, 4.0f * std::cos(angle)}, {0.0f, 1.0f, 0.0f}));
    }
    return cameras;
}

bool same(const CameraDescription& a, const CameraDescription& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg &&
           a.aperture_radius == b.aperture_radius && a.focus_distance == b.focus_distance;
}

std::string refused(std::vector<CameraDescription> cameras) {
    try {
        CameraPath path(std::move(cameras));
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Usage);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("A camera path passes through its cameras to the bit") {
    const std::vector<CameraDescription> cameras = circle(5);
    const CameraPath path(cameras);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        CHECK(same(path.at(static_cast<double>(i)), cameras[i]));
        CHECK(same(path.frame(static_cast<int>(7 * i), 29), cameras[i]));
    }
    CHECK(same(path.at(-1.0), cameras.front()));
    CHECK(same(path.at(99.0), cameras.back()));
    // Frames that do not divide the path: its ends are frames all the same.
    CHECK(same(path.frame(0, 10), cameras.front()));
    CHECK(same(path.frame(9, 10), cameras.back()));
}

TEST_CASE("Two cameras make a straight path with a steady turn") {
    CameraDescription to = camera({2.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f});
    to.target = to.eye + glm::vec3(1.0f, 0.0f, 0.0f);  // a right turn of 90 degrees
    to.fov_deg = 60.0f;
    to.focus_distance = 4.0f;
    const CameraPath path({camera({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}), to});
    const CameraDescription middle = path.at(0.5);
    CHECK(glm::length(middle.eye - glm::vec3(1.0f, 0.0f, 0.0f)) < 1.0e-6f);
    CHECK(glm::length(middle.target - middle.eye - glm::vec3(std::sqrt(0.5f), 0.0f, -std::sqrt(0.5f))) < 1.0e-5f);
    CHECK(std::fabs(middle.fov_deg - 50.0f) < 1.0e-4f);
    CHECK(std::fabs(middle.focus_distance - 2.0f) < 1.0e-5f);  // the geometric mean of 1 and 4
}

TEST_CASE("A path is smooth at its cameras: no jump of position, view or their speed") {
    const CameraPath path(circle(6));
    constexpr double kStep = 1.0e-2;
    for (int i = 1; i < 5; ++i) {
        const CameraDescription before = path.at(i - kStep);
        const CameraDescription at = path.at(i);
        const CameraDescription after = path.at(i + kStep);
        const auto bend = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
            return glm::length((c - b) - (b - a)) / std::max(glm::length(c - a), 1.0e-6f);
        };
        CHECK(bend(before.eye, at.eye, after.eye) < 0.05f);
        CHECK(bend(before.target - before.eye, at.target - at.eye, after.target - after.eye) < 0.05f);
    }
}

TEST_CASE("A path turns by the shorter way around and stays level") {
    // From 170 to 190 degrees: through 180, not through 0.
    const auto looking = [](float degrees) {
        const float angle = degrees * 0.017453293f;
        return camera({0.0f, 0.0f, 0.0f}, {std::sin(angle), 0.0f, std::cos(angle)});
    };
    const CameraPath path({looking(170.0f), looking(-170.0f)});
    CHECK(path.at(0.5).target.z < -0.99f);
    const CameraPath around(circle(4));
    for (double at = 0.0; at <= 3.0; at += 0.1) {
        const CameraDescription camera = around.at(at);
        CHECK(camera.up == glm::vec3(0.0f, 1.0f, 0.0f));
        CHECK(std::fabs(camera.target.y - camera.eye.y) < 1.0e-4f);
    }
}

TEST_CASE("A path through the vertical keeps a direction") {
    const CameraPath path({camera({0.0f, 2.0f, 3.0f}, {0.0f, 0.0f, 0.0f}),
                           camera({0.0f, 4.0f, 0.0f}, glm::vec3(0.0f)),
                           camera({0.0f, 2.0f, -3.0f}, glm::vec3(0.0f))});
    for (double at = 0.0; at <= 2.0; at += 0.05) {
        const CameraDescription camera = path.at(at);
        CHECK(std::isfinite(camera.target.x + camera.target.y + camera.target.z));
        CHECK(glm::length(camera.target - camera.eye) > 1.0f);
    }
}

TEST_CASE("A path needs two cameras, each with a direction") {
    CHECK(refused({}) == "a camera path: expected at least 2 cameras, got 0");
    CHECK(refused({camera({1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f})}) ==
          "a camera path: expected at least 2 cameras, got 1");
    CHECK(refused({camera({1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}), camera({1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f})})
              .find("camera 2 of a path: expected a target away from the eye") == 0);
}
