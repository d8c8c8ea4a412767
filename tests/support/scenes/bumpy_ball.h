// A model of any size, made on the spot: a ball with bumps on a floor under a lamp, or in a room, as OBJ and MTL files.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

namespace pl::test {

/// Triangles of a ball with so many rows of quads; its two outermost rows are fans.
constexpr std::size_t ball_triangles(std::size_t rows) { return 4 * rows * (rows - 1); }
/// The floor and the lamp.
inline constexpr std::size_t kBesideBall = 4;

/// Around the ball: nothing, or walls and a ceiling, so that no path leaves the scene.
enum class BallSurroundings { Open, Room };

/// Writes ball.obj and ball.mtl into a folder; returns the path of the former. `rows` is at least 2; 51 rows make ten
/// thousand triangles, 501 a million, 1582 ten million. The ball hangs clear of the floor, in meters, and is closed.
inline std::filesystem::path write_bumpy_ball(const std::filesystem::path& folder, std::size_t rows,
                                              BallSurroundings surroundings = BallSurroundings::Open) {
    constexpr double kPi = 3.14159265358979323846;
    const std::size_t columns = 2 * rows;
    std::string text = "mtllib ball.mtl\n";
    const auto out = [&] { return std::back_inserter(text); };
    const auto add = [&](double x, double y, double z) {
        fmt::format_to(out(), "v {:.7f} {:.7f} {:.7f}\n", x, y, z);
    };
    add(0.0, 2.1, 0.0);
    for (std::size_t row = 1; row < rows; ++row) {
        const double theta = kPi * static_cast<double>(row) / static_cast<double>(rows);
        for (std::size_t column = 0; column < columns; ++column) {
            const double phi = 2.0 * kPi * static_cast<double>(column) / static_cast<double>(columns);
            const double bump = 0.05 * std::sin(12.0 * theta) * std::sin(11.0 * phi) * std::sin(theta);
            const double radius = 1.0 + bump;
            add(radius * std::sin(theta) * std::cos(phi), 1.1 + radius * std::cos(theta),
                -radius * std::sin(theta) * std::sin(phi));
        }
    }
    add(0.0, 0.1, 0.0);
    const std::size_t last = 2 + columns * (rows - 1);  // OBJ counts from 1
    const auto vertex = [&](std::size_t row, std::size_t column) {
        return 2 + (row - 1) * columns + column % columns;
    };
    text += "o ball\nusemtl clay\n";
    for (std::size_t column = 0; column < columns; ++column) {
        fmt::format_to(out(), "f 1 {} {}\n", vertex(1, column), vertex(1, column + 1));
        fmt::format_to(out(), "f {} {} {}\n", last, vertex(rows - 1, column + 1), vertex(rows - 1, column));
    }
    for (std::size_t row = 1; row + 1 < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t a = vertex(row, column);
            const std::size_t b = vertex(row + 1, column);
            const std::size_t c = vertex(row + 1, column + 1);
            fmt::format_to(out(), "f {} {} {}\nf {} {} {}\n", a, b, c, a, c, vertex(row, column + 1));
        }
    text += "o floor\nusemtl floor\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nv -4 0 -4\nf -4 -3 -2\nf -4 -2 -1\n"
            "o lamp\nusemtl lamp\nv -1 4 -1\nv 1 4 -1\nv 1 4 1\nv -1 4 1\nf -4 -3 -2\nf -4 -2 -1\n";
    if (surroundings == BallSurroundings::Room)
        text +=
            "o room\nusemtl floor\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nv -4 5 -4\nv 4 5 -4\nv 4 5 4\nv -4 5 4\n"
            "f -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\nf -4 -3 -2 -1\n";
    const std::filesystem::path path = folder / "ball.obj";
    std::ofstream(path, std::ios::binary) << text;
    std::ofstream(folder / "ball.mtl", std::ios::binary)
        << "newmtl clay\nKd 0.6 0.4 0.3\nnewmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 12 12 12\n";
    return path;
}

}  // namespace pl::test
