// Trees of the volumes that can agree with a normal: searches in them find the same volume as among all.
#include "core/fields/normal_trees.h"

#include <thread>

#include "tests/support/catch.hpp"
#include "tests/support/field/linear_search.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

std::vector<KdNode> random_nodes(std::uint32_t count, Uniforms& random) {
    std::vector<KdNode> nodes;
    for (std::uint32_t i = 0; i < count; ++i)
        nodes.push_back({.position = random.direction(), .volume = i, .normal = random.direction(), .axis = 0});
    return nodes;
}

/// A normal on the cone of the largest angle around the given one, up to 1e-6.
Vec3f near_cone(Vec3f axis, Uniforms& random) {
    const Vec3f across = glm::normalize(glm::cross(axis, random.direction()));
    const float cosine = kMinNormalCosine + random.between(-1e-6f, 1e-6f);
    return cosine * axis + std::sqrt(1.0f - cosine * cosine) * across;
}

}  // namespace

TEST_CASE("Normal trees: the nearest volume is that among all, also at the largest angle and on cube edges") {
    Uniforms random(4);
    for (const std::uint32_t count : {0u, 1u, 5u, 40u, 300u}) {
        const std::vector<KdNode> nodes = random_nodes(count, random);
        NormalTrees trees(view_of(nodes));
        bool is_same = true;
        const auto compare = [&](Vec3f normal) {
            const Vec3f position = random.direction();
            const std::int32_t found = find_volume(trees.tree_of(NormalTrees::cell_of(normal)), position, normal);
            is_same = is_same && found == find_volume_by_all(view_of(nodes), position, normal);
            if (found != kNoVolume)
                is_same =
                    is_same && trees.node_of(static_cast<std::uint32_t>(found)) == static_cast<std::uint32_t>(found);
        };
        for (std::uint32_t i = 0; i < 20000; ++i) {
            compare(random.direction());
            if (count > 0) compare(near_cone(nodes[i % count].normal, random));
        }
        for (const float x : {-1.0f, 0.0f, 1.0f})
            for (const float y : {-1.0f, 0.0f, 1.0f})
                for (const float z : {-1.0f, 0.0f, 1.0f})
                    if (x != 0.0f || y != 0.0f || z != 0.0f) compare(glm::normalize(Vec3f{x, y, z}));
        CHECK(is_same);
    }
}

TEST_CASE("Normal trees leave out most volumes of a ball") {
    Uniforms random(5);
    const std::vector<KdNode> nodes = random_nodes(2000, random);
    NormalTrees trees(view_of(nodes));
    for (int i = 0; i < 100; ++i) CHECK(trees.tree_of(NormalTrees::cell_of(random.direction())).nodes.count < 600);
}

TEST_CASE("Normal trees are the same for several threads that ask at once") {
    Uniforms random(6);
    const std::vector<KdNode> nodes = random_nodes(500, random);
    NormalTrees trees(view_of(nodes));
    const KdNode* first[2][6] = {};
    const auto ask = [&](int thread) {
        for (int i = 0; i < 6; ++i) {
            Vec3f normal{0.0f};
            normal[i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
            first[thread][i] = trees.tree_of(NormalTrees::cell_of(normal)).nodes.data;
        }
    };
    std::thread other(ask, 1);
    ask(0);
    other.join();
    for (int i = 0; i < 6; ++i) CHECK(first[0][i] == first[1][i]);
}
