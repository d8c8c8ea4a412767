// Directions carried between a site and the points around it: they meet on the sphere, and no solid angle is lost.
#include "core/kernel/guiding/parallax.h"

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr Vec3f kSite{0.3f, -0.2f, 0.7f};
constexpr float kRadius = 2.0f;

Parallax<One> at(Vec3f point, float inverse_reach = 1.0f / kRadius) {
    return {unpack(kSite), unpack(point), inverse_reach};
}

/// Distance along wi from a point inside to the sphere around the site.
double way_to_sphere(Vec3d point, Vec3d wi) {
    const Vec3d offset = point - Vec3d{kSite};
    const double along = glm::dot(offset, wi);
    return -along + std::sqrt(along * along + double{kRadius} * double{kRadius} - glm::dot(offset, offset));
}

}  // namespace

TEST_CASE("A point and its site look at the same place on the sphere") {
    Uniforms random(1);
    for (int i = 0; i < 10000; ++i) {
        const Vec3f point = kSite + random.between(0.0f, 0.85f) * kRadius * random.direction();
        const Vec3f wi = random.direction();
        const Vec3d target = Vec3d{point} + way_to_sphere(Vec3d{point}, Vec3d{wi}) * Vec3d{wi};
        const Vec3d expected = (target - Vec3d{kSite}) / double{kRadius};
        const Vec3f seen = pack(at(point).to_site(unpack(wi)).direction);
        REQUIRE(glm::length(Vec3d{seen} - expected) < 2e-6);
    }
}

TEST_CASE("Directions come back from the site, from everywhere") {
    Uniforms random(2);
    for (int i = 0; i < 10000; ++i) {
        // Also far outside of the sphere, where a point counts as if it were on its way there.
        const Vec3f point = kSite + random.between(0.0f, 3.0f) * kRadius * random.direction();
        const Parallax<One> parallax = at(point);
        const Vec3f seen = random.direction();
        const Vec3f wi = pack(parallax.to_point(unpack(seen)));
        REQUIRE(std::fabs(glm::length(wi) - 1.0f) < 1e-6f);
        REQUIRE(glm::length(pack(parallax.to_site(unpack(wi)).direction) - seen) < 5e-6f);
    }
}

// The midpoint rule with 512 x 1024 points: its error here is below 1e-5.
TEST_CASE("All directions at a point are all directions at its site") {
    constexpr int kRows = 512;
    for (const float distance : {0.0f, 0.3f, 0.7f, 0.9f, 5.0f}) {
        const Parallax<One> parallax = at(kSite + distance * kRadius * glm::normalize(Vec3f{1.0f, 2.0f, -0.5f}));
        double sum = 0.0;
        for (int y = 0; y < kRows; ++y)
            for (int x = 0; x < 2 * kRows; ++x) {
                const double z = (y + 0.5) / kRows * 2.0 - 1.0;
                const double angle = (x + 0.5) / (2 * kRows) * kTurn;
                const double radius = std::sqrt(1.0 - z * z);
                const Vec3f wi{Vec3d{radius * std::cos(angle), radius * std::sin(angle), z}};
                sum += static_cast<double>(parallax.to_site(unpack(wi)).jacobian);
            }
        INFO("distance " << distance);
        CHECK(sum / (2.0 * kRows * kRows) == Approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("Solid angles change within bounds") {
    Uniforms random(3);
    for (int i = 0; i < 100000; ++i) {
        const Vec3f point = kSite + random.between(0.0f, 3.0f) * kRadius * random.direction();
        const float steradians = at(point).to_site(unpack(random.direction())).jacobian;
        REQUIRE(steradians > 0.0099f);
        REQUIRE(steradians < 3.7f);
    }
}

TEST_CASE("Light from infinitely far away has no parallax, not by a bit") {
    Uniforms random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f wi = random.direction();
        const Parallax<One> parallax = at(1000.0f * random.direction(), 0.0f);
        const SiteDirection<One> seen = parallax.to_site(unpack(wi));
        CHECK(pack(seen.direction) == wi);
        CHECK(seen.jacobian == 1.0f);
    }
}
