#include "core/fields/disc_frame.h"

#include "core/kernel/base/warp.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

CameraDescription camera_looking(Vec3f direction) {
    return {.eye = {1.0f, 2.0f, 3.0f}, .target = Vec3f{1.0f, 2.0f, 3.0f} + direction};
}

void check_vector(Vec3f got, Vec3f expected) {
    CAPTURE(got.x, got.y, got.z, expected.x, expected.y, expected.z);
    CHECK(glm::length(got - expected) < 1.0e-5f);
}

}  // namespace

TEST_CASE("on a wall the scene's up is up, and the disc is seen from in front") {
    // A wall that faces +z, -x or in between: seen against its normal, right is up x normal.
    for (const Vec3f normal : {Vec3f{0, 0, 1}, Vec3f{-1, 0, 0}, glm::normalize(Vec3f{0.3f, 0.4f, -0.9f})}) {
        const DiscFrame frame(normal, camera_looking(-normal));
        CHECK(frame.up_is_scene());
        const Vec3f up = glm::normalize(Vec3f{0, 1, 0} - normal.y * normal);
        check_vector(frame.up(), up);
        check_vector(frame.right(), glm::cross(up, normal));
        check_vector(frame.direction_of({0.0f, 0.0f}), normal);
        const auto point = frame.point_of(glm::normalize(normal + up));
        REQUIRE(point);
        CHECK(std::fabs(point->x) < 1.0e-5f);
        CHECK_THAT(point->y, WithinAbs(std::sqrt(0.5f), 1.0e-5f));
    }
}

TEST_CASE("on floor and ceiling up is up in the picture") {
    const Vec3f ahead = glm::normalize(Vec3f{0.6f, 0.0f, 0.8f});
    for (const float pitch : {-0.5f, 0.0f, 0.5f}) {
        const CameraDescription camera = camera_looking(ahead + Vec3f{0.0f, pitch, 0.0f});
        const DiscFrame floor({0, 1, 0}, camera);
        CHECK_FALSE(floor.up_is_scene());
        check_vector(floor.up(), ahead);
        const DiscFrame ceiling({0, -1, 0}, camera);
        check_vector(ceiling.up(), -ahead);
        // Right is the camera's right on both: floor and ceiling are seen from between them.
        check_vector(floor.right(), glm::cross(ahead, Vec3f{0, 1, 0}));
        check_vector(ceiling.right(), floor.right());
    }
    // Straight down, the camera's up is along the floor.
    const CameraDescription down{.eye = {0, 5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};
    check_vector(DiscFrame({0, 1, 0}, down).up(), {0, 0, -1});
}

TEST_CASE("points of the cells' disk and of the disc are the same directions") {
    for (const Vec3f normal : {Vec3f{0, 0, 1}, Vec3f{0, 1, 0}, glm::normalize(Vec3f{-0.7f, 0.2f, -0.4f})}) {
        const DiscFrame frame(normal, camera_looking({1.0f, -0.3f, 0.2f}));
        for (const Vec2f disk : {Vec2f{0.3f, -0.6f}, Vec2f{-0.1f, 0.9f}}) {
            const Vec2f disc = frame.from_cells(disk);
            check_vector(frame.direction_of(disc), make_frame(normal).to_world(lift_to_hemisphere(disk)));
            const Vec2f back = frame.to_cells(disc);
            CHECK_THAT(back.x, WithinAbs(disk.x, 1.0e-6f));
            CHECK_THAT(back.y, WithinAbs(disk.y, 1.0e-6f));
            const auto point = frame.point_of(frame.direction_of(disc));
            REQUIRE(point);
            CHECK_THAT(point->x, WithinAbs(disc.x, 1.0e-6f));
            CHECK_THAT(point->y, WithinAbs(disc.y, 1.0e-6f));
        }
        CHECK_FALSE(frame.point_of(-normal));
    }
}
