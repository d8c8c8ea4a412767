#include "ui/draw/lobes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/kernel/base/frame.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/guiding/direction_cells.h"
#include "ui/draw/direction_disc.h"

namespace pl::ui {
namespace {

constexpr float kClearAlpha = 0.22f;   ///< of the half of a dome towards the camera, relative to the other
constexpr float kLeastLength = 0.02f;  ///< of a lobe, so that a cell without density is part of the surface
constexpr float kFineFlowerPixels = 22.0f;
constexpr ValueRange kFlowerRange{.scale = ColorScale::Logarithmic, .low = 0.25f, .high = 40.0f};

struct Corner {
    Vec3f position;
    Vec2f window;
    float depth;
    float place;  ///< in the color map
};

struct ShadedTriangle {
    std::array<std::uint32_t, 3> corners;
    float depth;
    float shade;
    float alpha;
};

/// Values at the corners of cells: means of the cells around.
std::vector<float> at_corners(std::span<const float> cells, int side) {
    std::vector<float> corners;
    for (int row = 0; row <= side; ++row)
        for (int column = 0; column <= side; ++column) {
            float sum = 0.0f;
            int count = 0;
            for (int y = std::max(row - 1, 0); y <= std::min(row, side - 1); ++y)
                for (int x = std::max(column - 1, 0); x <= std::min(column, side - 1); ++x, ++count)
                    sum += cells[static_cast<std::size_t>(y * side + x)];
            corners.push_back(sum / static_cast<float>(count));
        }
    return corners;
}

/// One glyph on its way into a mesh.
class GlyphBuilder {
public:
    GlyphBuilder(const LobeGlyph& glyph, LobeShape shape, const Projection& projection)
        : glyph_(glyph), shape_(shape), projection_(projection), frame_(make_frame(glyph.normal)) {}

    void add_to(ScreenMesh& mesh) {
        if (!place_corners()) return;
        for (int row = 0; row < glyph_.side; ++row)
            for (int column = 0; column < glyph_.side; ++column) {
                const auto corner = [&](int x, int y) {
                    return static_cast<std::uint32_t>((row + y) * (glyph_.side + 1) + column + x);
                };
                add_triangle({corner(0, 0), corner(1, 0), corner(1, 1)});
                add_triangle({corner(0, 0), corner(1, 1), corner(0, 1)});
            }
        std::ranges::stable_sort(triangles_, std::ranges::greater{}, &ShadedTriangle::depth);
        for (const ShadedTriangle& triangle : triangles_) write(mesh, triangle);
    }

private:
    /// False if one of them has no place in the window.
    bool place_corners() {
        const std::vector<float> lengths = at_corners(glyph_.lengths, glyph_.side);
        const std::vector<float> places = at_corners(glyph_.positions, glyph_.side);
        for (int row = 0; row <= glyph_.side; ++row)
            for (int column = 0; column <= glyph_.side; ++column) {
                const auto side = static_cast<float>(glyph_.side);
                const std::size_t index = corners_.size();
                const float length = shape_ == LobeShape::Dome ? 1.0f : std::max(lengths[index], kLeastLength);
                const Vec2f disk =
                    square_to_disk({static_cast<float>(column) / side, static_cast<float>(row) / side});
                const Vec3f position =
                    glyph_.position + length * glyph_.radius * frame_.to_world(lift_to_hemisphere(disk));
                const auto point = projection_(position);
                if (!point) return false;
                corners_.push_back({position, point->window, point->depth, places[index]});
            }
        return true;
    }

    void add_triangle(const std::array<std::uint32_t, 3>& corners) {
        const Corner& a = corners_[corners[0]];
        const Corner& b = corners_[corners[1]];
        const Corner& c = corners_[corners[2]];
        Vec3f normal = glm::cross(b.position - a.position, c.position - a.position);
        const float area = glm::length(normal);
        if (!(area > 0.0f)) return;
        const Vec3f middle = (a.position + b.position + c.position) / 3.0f;
        if (glm::dot(normal, middle - glyph_.position) < 0.0f) normal = -normal;
        const float slope = glm::dot(normal / area, glm::normalize(projection_.eye() - middle));
        if (shape_ == LobeShape::Lobe && slope <= 0.0f) return;
        const bool is_clear = shape_ == LobeShape::Dome && slope > 0.0f;
        triangles_.push_back({corners, (a.depth + b.depth + c.depth) / 3.0f,
                              shape_ == LobeShape::Lobe ? 0.55f + 0.45f * slope : 1.0f,
                              is_clear ? kClearAlpha : 1.0f});
    }

    void write(ScreenMesh& mesh, const ShadedTriangle& triangle) const {
        const auto alpha = static_cast<std::uint8_t>(std::lround(static_cast<float>(glyph_.alpha) * triangle.alpha));
        for (const std::uint32_t index : triangle.corners) {
            const std::uint32_t color = map_color(corners_[index].place, alpha);
            const auto shaded = [&](int shift) {
                return static_cast<std::uint32_t>(static_cast<float>(color >> shift & 255u) * triangle.shade)
                       << shift;
            };
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.points.size()));
            mesh.points.push_back(corners_[index].window);
            mesh.colors.push_back((color & 0xff000000u) | shaded(0) | shaded(8) | shaded(16));
        }
    }

    const LobeGlyph& glyph_;
    LobeShape shape_;
    const Projection& projection_;
    Frame frame_;
    std::vector<Corner> corners_;
    std::vector<ShadedTriangle> triangles_;
};

/// A flower that may be seen.
struct SeenFlower {
    const FlowerField::Flower* flower;
    float depth;
    float pixels;  ///< of its radius
};

std::vector<SeenFlower> seen_flowers(const FlowerField& field, const SceneView& scene, const Projection& projection,
                                     FlowerCounts& counts) {
    const BvhIntersector intersector{scene};
    std::vector<SeenFlower> seen;
    for (const FlowerField::Flower& flower : field.flowers) {
        const Vec3f to_eye = projection.eye() - flower.position;
        if (glm::dot(flower.normal, to_eye) <= 0.0f) {
            ++counts.away;
            continue;
        }
        const Vec3f top = flower.position + field.radius * flower.normal;
        const auto middle = projection(flower.position);
        if (!middle || !projection.may_show(flower.position, field.radius)) {
            ++counts.outside;
            continue;
        }
        if (intersector.occluded({.origin = projection.eye(), .direction = top - projection.eye(), .t_max = 1.0f})) {
            ++counts.hidden;
            continue;
        }
        seen.push_back({&flower, middle->depth, projection.pixels_of(field.radius, middle->depth)});
    }
    std::ranges::stable_sort(seen, std::ranges::greater{}, &SeenFlower::depth);
    return seen;
}

}  // namespace

void add_glyph(ScreenMesh& mesh, const LobeGlyph& glyph, LobeShape shape, const Projection& projection) {
    const auto cells = static_cast<std::size_t>(glyph.side) * static_cast<std::size_t>(glyph.side);
    if (cells == 0 || glyph.lengths.size() != cells || glyph.positions.size() != cells) return;
    GlyphBuilder(glyph, shape, projection).add_to(mesh);
}

std::vector<float> coarser_cells(std::span<const float> cells, int side, int coarse) {
    const auto count = static_cast<std::size_t>(coarse) * static_cast<std::size_t>(coarse);
    std::vector<float> sums(count, 0.0f);
    std::vector<float> counts(count, 0.0f);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const auto index = static_cast<std::size_t>(row * coarse / side * coarse + column * coarse / side);
            sums[index] += cells[static_cast<std::size_t>(row * side + column)];
            counts[index] += 1.0f;
        }
    for (std::size_t i = 0; i < count; ++i) sums[i] /= counts[i];
    return sums;
}

Vec3f peak_direction(Vec3f normal, int side, std::span<const float> values) {
    const auto cell = static_cast<int>(std::ranges::max_element(values) - values.begin());
    const Vec2f disk = square_to_disk(DirectionCells{side}.point_in_cell(cell, Vec2f{0.5f}));
    return make_frame(normal).to_world(lift_to_hemisphere(disk));
}

ScreenMesh flower_mesh(const FlowerField& field, const SceneView& scene, const Projection& projection,
                       FlowerCounts& counts) {
    constexpr auto kTrianglesOf = [](int side) { return static_cast<std::size_t>(2 * side * side); };
    ScreenMesh mesh;
    const std::vector<SeenFlower> seen = seen_flowers(field, scene, projection, counts);
    std::size_t left =
        kMostFlowerTriangles - std::min(kMostFlowerTriangles, seen.size() * kTrianglesOf(field.coarse_side));
    // The nearest, which are last, are the first to be fine.
    std::vector<bool> is_fine(seen.size(), false);
    for (std::size_t i = seen.size(); i-- > 0;) {
        const std::size_t more = kTrianglesOf(field.fine_side) - kTrianglesOf(field.coarse_side);
        if (seen[i].pixels < kFineFlowerPixels || left < more) continue;
        is_fine[i] = true;
        left -= more;
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::vector<float>& density = is_fine[i] ? seen[i].flower->fine : seen[i].flower->coarse;
        const float peak = std::max(*std::ranges::max_element(density), 1.0e-30f);
        std::vector<float> lengths;
        for (const float value : density) lengths.push_back(value / peak);
        const std::vector<float> positions = positions_in(kFlowerRange, density);
        add_glyph(mesh,
                  {.position = seen[i].flower->position,
                   .normal = seen[i].flower->normal,
                   .radius = field.radius,
                   .side = is_fine[i] ? field.fine_side : field.coarse_side,
                   .lengths = lengths,
                   .positions = positions},
                  LobeShape::Lobe, projection);
    }
    counts.drawn = seen.size();
    counts.triangles = mesh.triangles();
    return mesh;
}

}  // namespace pl::ui
