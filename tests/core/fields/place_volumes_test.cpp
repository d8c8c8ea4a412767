// Placement of volumes: in proportion to area, on every surface, on the sides that light reaches, reproducibly.
#include <algorithm>
#include <set>

#include "core/fields/place_volumes.h"
#include "core/fields/surfaces.h"
#include "tests/core/fields/lit_room.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/brute_force.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A horizontal square with its front up.
void add_sheet(SceneDescription& scene, float size, float y, std::uint32_t material) {
    const std::uint32_t a = add_vertex(scene, {-size, y, -size});
    const std::uint32_t b = add_vertex(scene, {-size, y, size});
    const std::uint32_t c = add_vertex(scene, {size, y, size});
    const std::uint32_t d = add_vertex(scene, {size, y, -size});
    add_quad(scene, a, b, c, d, material);
}

struct SideCount {
    int front = 0;
    int back = 0;
};

/// Volumes on each surface, by the side they face.
std::vector<SideCount> count_sides(const HostScene& scene, const Surfaces& surfaces, const HostVolumes& volumes) {
    std::vector<SideCount> counts(surfaces.list.size());
    for (const SurfacePoint& site : volumes.sites) {
        SideCount& count = counts[surfaces.of_triangle[site.primitive]];
        const bool front = glm::dot(site.geometric_normal, scene.planes[site.primitive].normal) > 0.0f;
        ++(front ? count.front : count.back);
    }
    return counts;
}

}  // namespace

TEST_CASE("Counts are the requested number in proportion to area") {
    const HostScene scene = pack_scene(lit_room());
    const Surfaces surfaces = find_surfaces(scene);
    double total = 0.0;
    for (const Surface& surface : surfaces.list) total += surface.area;
    for (const int asked : {12, 100, 1000, 5000}) {
        const HostVolumes volumes = place_volumes(scene, FieldSettings{.volumes = asked});
        REQUIRE(volumes.sites.size() == static_cast<std::size_t>(asked));
        CHECK(volumes.normals.size() == volumes.sites.size());
        CHECK(volumes.kd_nodes.size() == volumes.sites.size());
        const std::vector<SideCount> counts = count_sides(scene, surfaces, volumes);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double share = surfaces.list[i].area / total * asked;
            CHECK(counts[i].front >= 1);
            CHECK(counts[i].back == 0);
            // Rounded up or down, and less the volumes of surfaces below their share: at most one each.
            CHECK(std::fabs(counts[i].front - share) <= 1.0 + 12.0 * share / asked);
        }
    }
}

// One huge surface and thousands of tiny ones. As long as there are enough volumes every surface has one; else the
// number asked for is kept and area alone decides.
TEST_CASE("Tiny surfaces get one volume each if there are enough") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_triangle(description, Vec3f{-100, 0, -100}, Vec3f{0, 0, 100}, Vec3f{100, 0, -100});
    Uniforms random(1);
    for (int i = 0; i < 3000; ++i) {
        const Vec3f p = random.cube(-1, 1) + Vec3f{0, 2, 0};
        add_triangle(description, p, p + Vec3f{0.001f, 0, 0}, p + Vec3f{0, 0.001f, 0});
    }
    const HostScene scene = pack_scene(description);
    const Surfaces surfaces = find_surfaces(scene);
    REQUIRE(surfaces.list.size() == 3001);
    const HostVolumes enough = place_volumes(scene, FieldSettings{.volumes = 4000});
    CHECK(enough.sites.size() == 4000);
    const std::vector<SideCount> counts = count_sides(scene, surfaces, enough);
    CHECK(counts[0].front == 1000);
    CHECK(std::all_of(counts.begin() + 1, counts.end(), [](const SideCount& c) { return c.front == 1; }));
    const HostVolumes few = place_volumes(scene, FieldSettings{.volumes = 500});
    CHECK(few.sites.size() == 500);
    CHECK(count_sides(scene, surfaces, few)[0].front >= 499);
}

// With N volumes on an area A the mean spacing is sqrt(A/N).
TEST_CASE("Every point is within three mean spacings of a volume that serves it") {
    const HostScene scene = pack_scene(lit_room());
    const SceneView view = scene.view();
    const Surfaces surfaces = find_surfaces(scene);
    double total = 0.0;
    for (const Surface& surface : surfaces.list) total += surface.area;
    for (const int asked : {100, 1000}) {
        const HostVolumes volumes = place_volumes(scene, FieldSettings{.volumes = asked});
        const double spacing = std::sqrt(total / asked);
        Uniforms random(2);
        for (int i = 0; i < 50000; ++i) {
            const Vec2f b = square_to_triangle(random.square());
            const Hit hit{.t = 1, .primitive = random.below(view.triangles.count), .b1 = b.x, .b2 = b.y};
            const SurfacePoint point = make_surface_point<FeatureSet{}>(view, hit, view.planes[hit.primitive].normal);
            Nearest nearest;
            search_kd_tree({view_of(volumes.kd_nodes)}, point.position, point.geometric_normal, nearest);
            REQUIRE(nearest.volume != kNoVolume);
            REQUIRE(std::sqrt(static_cast<double>(nearest.distance2)) <= 3.0 * spacing);
        }
    }
}

// Every sixteenth of a square holds a sixteenth of its volumes, within the discrepancy of a Hammersley set.
TEST_CASE("Volumes cover a square evenly") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_sheet(description, 1.0f, 0.0f, 0);
    const HostVolumes volumes = place_volumes(pack_scene(description), FieldSettings{.volumes = 1600});
    std::vector<int> counts(16);
    for (const SurfacePoint& site : volumes.sites) {
        const int column = min_of(static_cast<int>((site.position.x + 1.0f) * 2.0f), 3);
        const int row = min_of(static_cast<int>((site.position.z + 1.0f) * 2.0f), 3);
        ++counts[static_cast<std::size_t>(row * 4 + column)];
    }
    for (const int count : counts)
        CHECK(std::abs(count - 100) <= 10);  // independent points would have a standard deviation of 10
}

TEST_CASE("Volumes stand inside their triangles and face their side") {
    const HostScene scene = pack_scene(lit_room());
    const HostVolumes volumes = place_volumes(scene, FieldSettings{.volumes = 1000});
    std::set<std::array<float, 3>> places;
    for (std::size_t i = 0; i < volumes.sites.size(); ++i) {
        const SurfacePoint& site = volumes.sites[i];
        REQUIRE(volumes.normals[i] == site.geometric_normal);
        places.insert({site.position.x, site.position.y, site.position.z});
        // A ray from above hits the triangle at this point, and not at an edge.
        const Ray ray{.origin = site.position + 0.01f * site.geometric_normal, .direction = -site.geometric_normal};
        const Hit hit = closest_hit_by_all(scene.view(), ray);
        REQUIRE(hit.primitive == site.primitive);
        REQUIRE(min_of(hit.b1, min_of(hit.b2, 1.0f - hit.b1 - hit.b2)) > 0.0f);
    }
    CHECK(places.size() == volumes.sites.size());
}

TEST_CASE("Only the sides that light reaches get volumes") {
    SceneDescription description;
    description.materials = {gray(), gray()};
    description.materials[1].emission = Vec3f{1.0f};
    add_sheet(description, 1.0f, 0.0f, 0);   // lit from below
    add_sheet(description, 1.0f, -1.0f, 1);  // the light: its front looks up
    const HostScene below = pack_scene(description);
    const Surfaces surfaces = find_surfaces(below);
    std::vector<SideCount> counts = count_sides(below, surfaces, place_volumes(below, FieldSettings{.volumes = 100}));
    REQUIRE(counts.size() == 2);
    CHECK(counts[0].front == 0);
    CHECK(counts[0].back == 50);
    CHECK(counts[1].front == 50);
    CHECK(counts[1].back == 0);

    add_sheet(description, 1.0f, 1.0f, 1);  // a second light above, with its back to the sheet
    const HostScene one_sided = pack_scene(description);
    counts =
        count_sides(one_sided, find_surfaces(one_sided), place_volumes(one_sided, FieldSettings{.volumes = 100}));
    CHECK(counts[0].front == 0);
    description.materials[1].two_sided_emission = true;
    const HostScene two_sided = pack_scene(description);
    counts =
        count_sides(two_sided, find_surfaces(two_sided), place_volumes(two_sided, FieldSettings{.volumes = 100}));
    CHECK(counts[0].front > 0);
    CHECK(counts[0].back == counts[0].front);
}

TEST_CASE("An environment lights both sides of a sheet and without any light it is the front") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_sheet(description, 1.0f, 0.0f, 0);
    const HostScene dark = pack_scene(description);
    std::vector<SideCount> counts =
        count_sides(dark, find_surfaces(dark), place_volumes(dark, FieldSettings{.volumes = 100}));
    CHECK(counts[0].front == 100);
    CHECK(counts[0].back == 0);
    description.environment = Vec3f{1.0f};
    const HostScene open = pack_scene(description);
    counts = count_sides(open, find_surfaces(open), place_volumes(open, FieldSettings{.volumes = 100}));
    CHECK(counts[0].front == 50);
    CHECK(counts[0].back == 50);
}

TEST_CASE("Nothing reflects and nothing is placed") {
    SceneDescription description;
    description.materials.push_back(gray(0.0f));
    add_sheet(description, 1.0f, 0.0f, 0);
    CHECK(place_volumes(pack_scene(description), FieldSettings{.volumes = 100}).sites.empty());
    CHECK(place_volumes(pack_scene(SceneDescription{}), FieldSettings{.volumes = 100}).sites.empty());
}

TEST_CASE("Placement is the same every time and scales with the scene bit by bit") {
    const HostVolumes first = place_volumes(pack_scene(lit_room()), FieldSettings{.volumes = 1000});
    const HostVolumes second = place_volumes(pack_scene(lit_room()), FieldSettings{.volumes = 1000}, nullptr, 3);
    REQUIRE(second.sites.size() == first.sites.size());
    for (const int exponent : {0, -20, 20}) {
        const float scale = std::ldexp(1.0f, exponent);
        SceneDescription description = lit_room();
        for (glm::vec3& p : description.positions) p *= scale;
        const HostVolumes scaled = place_volumes(pack_scene(description), FieldSettings{.volumes = 1000});
        REQUIRE(scaled.sites.size() == first.sites.size());
        bool same = true;
        for (std::size_t i = 0; i < first.sites.size(); ++i) {
            same = same && scaled.sites[i].position == first.sites[i].position * scale &&
                   scaled.normals[i] == first.normals[i] && scaled.kd_nodes[i].volume == first.kd_nodes[i].volume &&
                   scaled.kd_nodes[i].axis == first.kd_nodes[i].axis;
            same = same && second.sites[i].position == first.sites[i].position;
        }
        INFO("scaled by 2^" << exponent);
        CHECK(same);
    }
}
