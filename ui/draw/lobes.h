// Distributions over hemispheres as shapes in the scene: lobes, whose length is the density, and glass domes. As triangles in the
// window that can be tested without one, batched, and cheap to draw again while nothing changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/kernel/scene/scene_view.h"
#include "ui/draw/draw_list.h"

namespace pl::ui {

enum class LobeShape {
    Lobe,  ///< a surface at a distance from the volume in proportion to the value
    Dome,  ///< a hemisphere; the half towards the camera is nearly clear
};

/// Triangles in the window, farthest first. Colors are 0xAABBGGRR, one for each point.
struct ScreenMesh {
    std::vector<Vec2f> points{};
    std::vector<std::uint32_t> colors{};
    std::vector<std::uint32_t> indices{};

    std::size_t triangles() const { return indices.size() / 3; }
};

/// A hemisphere, divided into side x side DirectionCells. Arrays are [cell].
struct LobeGlyph {
    Vec3f position{0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};
    float radius = 1.0f;  ///< of the dome, and of the longest lobe; scene units
    int side = 0;
    std::span<const float> lengths{};    ///< shares of the radius, in [0, 1]
    std::span<const float> positions{};  ///< in the color map
    std::uint8_t alpha = 255;
};

/// Adds the triangles of a hemisphere: of a lobe those that face the camera, shaded by their slope; of a dome all, those that face
/// the camera nearly clear. Nothing for one that reaches behind the near plane.
void add_glyph(ScreenMesh& mesh, const LobeGlyph& glyph, LobeShape shape, const Projection& projection);

/// Means of cells over a coarser division. side >= coarse.
std::vector<float> coarser_cells(std::span<const float> cells, int side, int coarse);

/// Direction of the cell with the largest value, unit, in scene space.
Vec3f peak_direction(Vec3f normal, int side, std::span<const float> values);

/// The distributions of many volumes, for display. Independent of the camera.
struct FlowerField {
    /// Cells per side of flowers near the camera and of the others, if the field has as many.
    static constexpr int kFine = 8;
    static constexpr int kCoarse = 4;

    struct Flower {
        Vec3f position{0.0f};
        Vec3f normal{0.0f, 0.0f, 1.0f};
        std::vector<float> fine{};    ///< densities relative to cosine sampling, fine_side x fine_side
        std::vector<float> coarse{};  ///< the same, coarse_side x coarse_side
    };
    int fine_side = kFine;
    int coarse_side = kCoarse;
    float radius = 0.0f;  ///< of every flower, scene units
    std::vector<Flower> flowers{};
};

/// The work of flower_mesh().
struct FlowerCounts {
    std::size_t away = 0;     ///< flowers on surfaces that face away from the camera
    std::size_t outside = 0;  ///< outside of the picture
    std::size_t hidden = 0;   ///< by the scene
    std::size_t drawn = 0;
    std::size_t triangles = 0;
};

/// Most triangles of all flowers together: fine ones are drawn only as far as these last.
inline constexpr std::size_t kMostFlowerTriangles = 60000;
/// Most flowers of a field that are drawn, and so the least of n in "every n-th volume".
inline constexpr std::size_t kMostFlowers = 2000;

/// Flowers as lobes, each as long as the others at its own peak; colors are logarithmic in the density, from a quarter of
/// the density of cosine sampling to 40 times it. Flowers that face away, lie outside of the picture or are hidden by the scene cost no
/// triangle.
ScreenMesh flower_mesh(const FlowerField& field, const SceneView& scene, const Projection& projection,
                       FlowerCounts& counts);

}  // namespace pl::ui
