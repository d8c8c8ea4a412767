// Cells of directions: which one holds a direction, where they are, and that both agree.
#include "core/kernel/guiding/direction_cells.h"

#include "core/kernel/base/frame.h"

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;
using test::Uniforms;

TEST_CASE("A point in a cell leads back to the cell through square and hemisphere and world") {
    Uniforms random(1);
    for (int side = 2; side <= 32; ++side) {
        const DirectionCells cells{side};
        for (int cell = 0; cell < cells.count(); ++cell) {
            const Vec2f inside[] = {{0.0f, 0.0f}, {kAlmostOne, kAlmostOne}, {0.0f, kAlmostOne}, {kAlmostOne, 0.5f},
                                    {0.5f, 0.5f}, random.square()};
            for (const Vec2f u : inside) {
                const Vec2f square = cells.point_in_cell(cell, u);
                REQUIRE(cells.cell_of(square) == cell);
                const Vec3f local = square_to_cosine_hemisphere(square);
                REQUIRE(cells.cell_of(cosine_hemisphere_to_square(local)) == cell);
                const Frame frame = make_frame(random.direction());
                REQUIRE(cells.cell_of(cosine_hemisphere_to_square(frame.to_local(frame.to_world(local)))) == cell);
            }
        }
    }
}

// Light that arrives evenly through all cells leaves a white surface undiminished: the sum over cells of the cosine times the
// solid angle, over pi, is 1. Each cell has its equal share, as areas of the disc below the hemisphere. Outlines are polygons:
// chords of 2 pi / 2048 or less cut off a share of 2e-6 of a cell that is round, of all cells 4e-7; and borders are off by up
// to 1e-6 of the square, which is side times as much of the area of a cell.
TEST_CASE("Cells of every grid share the cosine of the hemisphere equally and lose none", "[hard]") {
    constexpr double kPi = 3.14159265358979323846;
    constexpr int kChords = 512;  // of each side of a cell
    for (int side = 2; side <= kMaxSide; ++side) {
        const auto at = [&](int column, int row) {
            const float scale = 1.0f / static_cast<float>(side * kChords);
            const Vec3f v = square_to_cosine_hemisphere(
                Vec2f{static_cast<float>(column) * scale, static_cast<float>(row) * scale});
            return glm::dvec2{v};
        };
        double sum = 0.0;
        double worst = 0.0;
        for (int cell = 0; cell < side * side; ++cell) {
            const int left = cell % side * kChords;
            const int low = cell / side * kChords;
            double area = 0.0;
            const auto add = [&](glm::dvec2 a, glm::dvec2 b) { area += 0.5 * (a.x * b.y - a.y * b.x); };
            for (int i = 0; i < kChords; ++i) {
                add(at(left + i, low), at(left + i + 1, low));
                add(at(left + kChords, low + i), at(left + kChords, low + i + 1));
                add(at(left + kChords - i, low + kChords), at(left + kChords - i - 1, low + kChords));
                add(at(left, low + kChords - i), at(left, low + kChords - i - 1));
            }
            sum += std::fabs(area) / kPi;
            worst = std::fmax(worst, std::fabs(std::fabs(area) / kPi * side * side - 1.0));
        }
        INFO(side << " cells to a side");
        CHECK(std::fabs(sum - 1.0) <= 1e-6);
        CHECK(worst <= 2e-6 + 4e-6 * side);
    }
}

// Directions that were not made by a cell may lie on a border; then rounding may name the neighbor, and nothing else.
TEST_CASE("Directions keep their cell or the neighbour on the way through the world") {
    Uniforms random(2);
    const DirectionCells cells{12};
    int moved = 0;
    float largest = 0.0f;
    for (int i = 0; i < 2000000; ++i) {
        const Vec3f local = square_to_cosine_hemisphere(random.square());
        const Vec2f square = cosine_hemisphere_to_square(local);
        const Frame frame = make_frame(random.direction());
        const Vec2f back = cosine_hemisphere_to_square(frame.to_local(frame.to_world(local)));
        largest = max_of(largest, max_of(std::fabs(back.x - square.x), std::fabs(back.y - square.y)));
        moved += cells.cell_of(square) != cells.cell_of(back) ? 1 : 0;
    }
    CHECK(largest <= 1e-6f);
    CHECK(moved <= 200);  // a share of 1e-4
}

TEST_CASE("Cells are in range for every point of the closed square") {
    for (int side = 2; side <= 32; ++side) {
        const DirectionCells cells{side};
        for (const float x : {0.0f, 1e-45f, 0.5f, kAlmostOne, 1.0f})
            for (const float y : {0.0f, 1e-45f, 0.5f, kAlmostOne, 1.0f}) {
                const int cell = cells.cell_of({x, y});
                CHECK(cell >= 0);
                CHECK(cell < cells.count());
            }
        CHECK(cells.cell_of({0.0f, 0.0f}) == 0);
        CHECK(cells.cell_of({1.0f, 0.0f}) == side - 1);
        CHECK(cells.cell_of({0.0f, 1.0f}) == side * (side - 1));
        CHECK(cells.cell_of({1.0f, 1.0f}) == cells.count() - 1);
    }
    // The horizon and the normal.
    const DirectionCells cells{16};
    for (const Vec3f d : {Vec3f{1, 0, 0}, Vec3f{-1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, -1, 0}, Vec3f{0, 0, 1}}) {
        CHECK(cells.cell_of(cosine_hemisphere_to_square(d)) >= 0);
        CHECK(cells.cell_of(cosine_hemisphere_to_square(d)) < cells.count());
    }
}

TEST_CASE("The tent covers a cell width to each side") {
    CHECK(sample_tent<One>(0.0f) == -1.0f);
    CHECK(sample_tent<One>(0.5f) == 0.0f);
    CHECK(sample_tent<One>(kAlmostOne) < 1.0f);
    CHECK(sample_tent<One>(0.125f) == -0.5f);
    CHECK(sample_tent<One>(0.875f) == 0.5f);
    float before = -2.0f;
    for (int i = 0; i < 100000; ++i) {
        const float x = sample_tent<One>(static_cast<float>(i) * 1e-5f);
        REQUIRE(x >= before);
        REQUIRE(std::fabs(x) <= 1.0f);
        before = x;
    }
}

TEST_CASE("Folding keeps coordinates in the square") {
    CHECK(reflect_into<One>(-0.25f, 16.0f) == 0.25f);
    CHECK(reflect_into<One>(16.25f, 16.0f) == 15.75f);
    CHECK(reflect_into<One>(3.5f, 16.0f) == 3.5f);
    CHECK(reflect_into<One>(0.0f, 16.0f) == 0.0f);
    CHECK(reflect_into<One>(16.0f, 16.0f) == 16.0f);
}
