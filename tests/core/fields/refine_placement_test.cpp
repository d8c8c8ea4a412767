// Refinement: the volumes that are split, the places and first tables of the new ones, and that no sample is lost.
#include "core/fields/refine_placement.h"

#include <algorithm>
#include <numeric>

#include "core/fields/volume_grid.h"
#include "core/kernel/guiding/update_volume.h"
#include "tests/core/fields/lit_room.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/linear_search.h"
#include "tests/support/rays/walk.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 4;
constexpr std::size_t kCells = kSide * kSide;

/// A placement with tables in which all volumes have received light from one side, in so many samples for each cell.
struct Learned {
    HostScene scene;
    FieldSettings settings;
    LitSurfaces surfaces;
    FieldShape shape;
    HostVolumes volumes;
    HostTables tables;

    explicit Learned(const SceneDescription& description, int count, std::uint32_t visits = 10)
        : scene(pack_scene(description)), settings{.volumes = count, .bins = kCells},
          surfaces(find_lit_surfaces(scene)) {
        shape = make_field_shape(scene, settings);
        volumes = place_volumes(scene, settings);
        tables = make_arrays<HostTables>(shape, volumes.normals.size());
        for (std::size_t i = 0; i < volumes.normals.size(); ++i) teach(i, visits, false);
    }

    TableField view() { return field_view(shape, volumes, tables); }
    SiteSource source(int threads = 1) const { return {scene, surfaces, settings, nullptr, threads}; }
    std::size_t count() const { return volumes.normals.size(); }

    /// Light from the first rows, or from the last ones.
    void teach(std::size_t volume, std::uint32_t visits, bool other_way) {
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            tables.radiance[volume * kCells + cell] = (cell < kCells / 2) != other_way ? 1.0f : 0.0f;
            tables.visits[volume * kCells + cell] = visits;
        }
        update_volume(update_view(shape, tables), static_cast<std::uint32_t>(volume));
        tables.inverse_reach[volume] = 0.0f;  // as if all light came from far away
    }

    RefinedPlacement refine(std::size_t most, int threads = 2) {
        const TableField field = view();
        return refine_placement(source(threads), field, volumes_to_split(field, most, threads));
    }
    void take(RefinedPlacement refined) {
        tables = split_field(shape, std::move(tables), refined.parents);
        volumes = std::move(refined.volumes);
    }
};

template <class Array>
double sum(const Array& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("Equal tables do not disagree, and the distance grows to 1 with their difference") {
    Learned field(lit_room(), 100);
    // A volume and its neighbor on one plane, and with one frame: around other axes, frames tell 0 from -0.
    const TableField view = field.view();
    const auto along_z = std::ranges::find_if(field.volumes.normals, [](Vec3f n) { return n.z == 1.0f; });
    const auto one = static_cast<std::int32_t>(along_z - field.volumes.normals.begin());
    NearestSeveral<2> pair;
    search_kd_tree(view.tree, view.sites[static_cast<std::uint32_t>(one)].position, *along_z, pair);
    REQUIRE(pair.found == 2);
    REQUIRE(pair.volume[0] == one);
    const std::int32_t other = pair.volume[1];
    CHECK(hellinger2(view, one, other) < 1e-6);
    double before = 0.0;
    for (const float floor : {0.9f, 0.5f, 0.1f, 0.001f}) {  // a large one hides the difference
        field.shape.uniform_floor = floor;
        field.teach(static_cast<std::size_t>(one), 1000, false);
        field.teach(static_cast<std::size_t>(other), 1000, true);
        const double now = hellinger2(field.view(), one, other);
        CHECK(now > before);
        CHECK(now <= 1.0);
        CHECK(hellinger2(field.view(), other, one) == Approx(now).margin(1e-5));
        before = now;
    }
    CHECK(before > 0.6);
}

TEST_CASE("The volume that serves many paths and that its neighbours contradict is split") {
    for (const std::size_t planted : {3u, 40u, 77u}) {
        Learned field(lit_room(), 100);
        field.teach(planted, 1000, true);            // many samples, unlike the others
        field.teach((planted + 10) % 100, 1, true);  // unlike the others, but few samples
        const RefinedPlacement refined = field.refine(1);
        REQUIRE(refined.parents.size() == 1);
        CHECK(refined.parents[0] == planted);
    }
}

TEST_CASE("No volume is split where nothing was learned or all agree") {
    Learned blank(lit_room(), 50, 0);
    CHECK(blank.refine(50).parents.empty());
    Learned single(lit_room(), 1);
    CHECK(single.refine(5).parents.size() <= 1);
}

TEST_CASE("New volumes stand where their parents served, the others keep place and number") {
    Learned field(lit_room(), 100);
    for (std::size_t i = 0; i < field.count(); i += 3) field.teach(i, 100, true);
    const Learned before = field;
    const RefinedPlacement refined = field.refine(60);
    REQUIRE(refined.parents.size() > 40);
    CHECK(refined.parents.size() <= 60);
    std::vector<std::uint32_t> unique = refined.parents;
    std::ranges::sort(unique);
    CHECK(std::ranges::adjacent_find(unique) == unique.end());
    REQUIRE(refined.volumes.sites.size() == before.count() + refined.parents.size());
    CHECK(refined.volumes.normals.size() == refined.volumes.sites.size());
    CHECK(refined.volumes.kd_nodes.size() == refined.volumes.sites.size());
    for (std::size_t i = 0; i < before.count(); ++i) {
        CHECK(refined.volumes.sites[i].position == before.volumes.sites[i].position);
        CHECK(refined.volumes.normals[i] == before.volumes.normals[i]);
    }
    for (std::size_t i = 0; i < refined.parents.size(); ++i) {
        const SurfacePoint& site = refined.volumes.sites[before.count() + i];
        CHECK(field.view().volume_at(site) == static_cast<std::int32_t>(refined.parents[i]));
        const Vec3f normal = refined.volumes.normals[before.count() + i];
        CHECK(normal == site.geometric_normal);
        CHECK(std::fabs(glm::dot(normal, normal) - 1.0f) < 1e-5f);
        CHECK(std::fabs(glm::dot(normal, field.scene.planes[site.primitive].normal)) > 0.99999f);
        CHECK(find_volume({.nodes = view_of(refined.volumes.kd_nodes)}, site.position, normal) ==
              static_cast<std::int32_t>(before.count() + i));
    }
}

TEST_CASE("A child stands well away from its parent, and takes about half of its cell") {
    Learned field(lit_room(), 40);
    for (std::size_t i = 0; i < field.count(); i += 2) field.teach(i, 100, true);
    const Learned before = field;
    RefinedPlacement refined = field.refine(40);
    const std::vector<std::uint32_t> parents = refined.parents;
    REQUIRE(parents.size() > 20);
    field.take(std::move(refined));
    std::vector<int> served(field.count(), 0);
    for_each_site(field.source(), 200, [&](const SurfacePoint& point) {
        ++served[static_cast<std::size_t>(field.view().volume_at(point))];
    });
    double share = 0.0;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const int own = served[before.count() + i];
        CHECK(own > 0);
        share += static_cast<double>(own) / (own + served[parents[i]]) / static_cast<double>(parents.size());
    }
    CHECK(share > 0.35);
    CHECK(share < 0.65);
}

TEST_CASE("No more volumes than requested, and none beyond the budget") {
    Learned field(lit_room(), 100);
    for (std::size_t i = 0; i < field.count(); i += 2) field.teach(i, 100, true);
    for (const std::size_t most : {0u, 1u, 7u, 30u}) CHECK(field.refine(most).parents.size() == most);

    FieldSettings settings;
    settings.refine_share = 0.0f;
    CHECK(most_refined_volumes(settings, 1000) == 1000);
    settings.refine_share = 0.25f;
    CHECK(most_refined_volumes(settings, 1000) == 1250);
    CHECK(most_refined_volumes(settings, 3) == 3);
    settings.refine_share = 1.0f;
    settings.budget_megabytes = 1500.5 * static_cast<double>(bytes_per_volume(settings.bins)) / 1e6;
    CHECK(most_refined_volumes(settings, 1000) == 1500);
    CHECK(most_refined_volumes(settings, 1600) == 1600);
    settings.volumes = 1000;  // a number that is given goes before the budget
    CHECK(most_refined_volumes(settings, 1000) == 2000);

    settings.refine_share = kRefineByRecords;
    CHECK(most_refined_volumes(settings, 1000) == 1000);
    settings.volumes = 0;
    CHECK(most_refined_volumes(settings, 1000) == 1500);
    settings.budget_megabytes *= 2.0;
    CHECK(most_refined_volumes(settings, 1000) == 2000);
}

TEST_CASE("Tree and grid find the volumes of a linear search in a refined placement") {
    Learned field(lit_room(), 200);
    for (std::size_t i = 0; i < field.count(); i += 2) field.teach(i, 100, true);
    field.take(field.refine(150));
    REQUIRE(field.count() == 350);
    field.volumes.grid = build_volume_grid(field.scene, field.volumes, 2);
    const KdTreeView tree{view_of(std::as_const(field.volumes.kd_nodes))};
    std::size_t points = 0;
    for_each_site(field.source(), 20, [&](const SurfacePoint& point) {
        const std::int32_t expected = find_volume_by_all(tree.nodes, point.position, point.geometric_normal);
        REQUIRE(expected != kNoVolume);
        REQUIRE(find_volume(tree, point.position, point.geometric_normal) == expected);
        REQUIRE(find_volume(tree, grid_view(field.volumes.grid), point).volume == expected);
        ++points;
    });
    CHECK(points >= 20 * 200);
}

TEST_CASE("A child begins with its parent's table, and no training sample is lost or counted twice") {
    Learned field(lit_room(), 30, 5);
    for (std::size_t i = 0; i < field.count(); i += 2) field.teach(i, 1 + static_cast<std::uint32_t>(i), true);
    Uniforms random(3);
    for (LargeArray<float>* sums : {&field.tables.mixture_target, &field.tables.mixture_weight,
                                    &field.tables.reach_distance, &field.tables.reach_weight})
        for (float& value : *sums) value = random.next();
    for (float& share : field.tables.bsdf_fraction) share = random.between(0.1f, 0.9f);
    for (std::uint32_t& count : field.tables.pending_count) count = random.below(3);
    for (std::int64_t& light : field.tables.pending_light) light = random.below(1000);
    const Learned before = field;
    const RefinedPlacement refined = field.refine(20);
    REQUIRE(refined.parents.size() == 20);
    const std::vector<std::uint32_t> parents = refined.parents;
    field.take(refined);

    const HostTables& now = field.tables;
    const HostTables& old = before.tables;
    CHECK(sum(now.visits) == sum(old.visits));
    CHECK(sum(now.pending_count) == sum(old.pending_count));
    CHECK(sum(now.pending_light) == sum(old.pending_light));
    CHECK(sum(now.mixture_weight) == Approx(sum(old.mixture_weight)));
    CHECK(sum(now.reach_weight) == Approx(sum(old.reach_weight)));
    CHECK(now.visits.size() == field.count() * kCells);
    CHECK(now.row_cdf.size() == field.count() * kSide);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const std::size_t parent = parents[i];
        const std::size_t child = before.count() + i;
        CHECK(now.mean_radiance[child] == old.mean_radiance[parent]);
        CHECK(now.bsdf_fraction[child] == old.bsdf_fraction[parent]);
        CHECK(now.inverse_reach[child] == old.inverse_reach[parent]);
        CHECK(now.mean_radiance[parent] == old.mean_radiance[parent]);
        for (std::size_t row = 0; row < kSide; ++row)
            CHECK(now.row_cdf[child * kSide + row] == old.row_cdf[parent * kSide + row]);
        std::uint32_t own = 0;
        std::uint32_t left = 0;
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            const std::size_t of_child = child * kCells + cell;
            const std::size_t of_parent = parent * kCells + cell;
            CHECK(now.column_cdf[of_child] == old.column_cdf[of_parent]);
            CHECK(now.visits[of_child] + now.visits[of_parent] == old.visits[of_parent]);
            for (const std::size_t half : {of_child, of_parent})
                CHECK(now.radiance[half] == (now.visits[half] > 0 ? old.radiance[of_parent] : 0.0f));
            own += now.visits[of_child];
            left += now.visits[of_parent];
        }
        CHECK(own == left);  // as many odd cells go to either
    }
}

TEST_CASE("Refinement does not depend on threads, and scales with the scene") {
    SceneDescription scene = lit_room();
    Learned field(scene, 300);
    for (std::size_t i = 0; i < field.count(); i += 2) field.teach(i, 100, true);
    const RefinedPlacement expected = field.refine(200, 1);
    for (const int threads : {2, 5}) {
        const RefinedPlacement refined = field.refine(200, threads);
        CHECK(refined.parents == expected.parents);
        for (std::size_t i = 0; i < refined.volumes.sites.size(); ++i)
            REQUIRE(refined.volumes.sites[i].position == expected.volumes.sites[i].position);
    }
    constexpr float kScale = 0x1p-20f;
    for (Vec3f& position : scene.positions) position *= kScale;
    Learned small(scene, 300);
    for (std::size_t i = 0; i < small.count(); i += 2) small.teach(i, 100, true);
    const RefinedPlacement refined = small.refine(200);
    CHECK(refined.parents == expected.parents);
    for (std::size_t i = 0; i < refined.volumes.sites.size(); ++i)
        REQUIRE(refined.volumes.sites[i].position == kScale * expected.volumes.sites[i].position);
}
