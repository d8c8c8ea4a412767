// Scenes as files, for tests that go through the command line.
#pragma once

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program/run_program.h"

namespace pl::test {

using Point = std::array<double, 3>;

/// An OBJ file in the making, with its MTL file.
class MeshFile {
public:
    void material(const std::string& name, const std::string& lines) {
        mtl_ << "newmtl " << name << "\n" << lines << "\n";
    }
    /// One polygon, its front where the corners run counter-clockwise.
    void face(const std::string& material, const std::vector<Point>& corners) {
        obj_ << "usemtl " << material << "\n";
        for (const Point& p : corners) obj_ << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << "\n";
        obj_ << "f";
        for (std::size_t i = 0; i < corners.size(); ++i) obj_ << " -" << corners.size() - i;
        obj_ << "\n";
    }
    /// Fronts inwards; materials of the faces x0, x1, y0, y1, z0, z1.
    void room(const std::array<std::string, 6>& materials) {
        const auto at = [](int i) { return Point{double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)}; };
        constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
        for (std::size_t f = 0; f < 6; ++f)
            face(materials[f], {at(kFaces[f][3]), at(kFaces[f][2]), at(kFaces[f][1]), at(kFaces[f][0])});
    }
    /// A sphere of rings x 2 rings facets; `material(z)` by the height of a facet's middle over the center, -1 to 1.
    template <class Material>
    void sphere(Point center, double radius, int rings, bool inwards, Material&& material) {
        constexpr double kPrecisePi = 3.14159265358979323846;
        const auto at = [&](int ring, int step) {
            const double theta = kPrecisePi * ring / rings;
            const double phi = kPrecisePi * step / rings;
            return Point{center[0] + radius * std::sin(theta) * std::cos(phi),
                         center[1] + radius * std::sin(theta) * std::sin(phi), center[2] + radius * std::cos(theta)};
        };
        for (int ring = 0; ring < rings; ++ring)
            for (int step = 0; step < 2 * rings; ++step) {
                std::vector<Point> corners{at(ring, step), at(ring + 1, step)};
                if (ring + 1 < rings) corners.push_back(at(ring + 1, step + 1));
                if (ring > 0) corners.push_back(at(ring, step + 1));
                if (inwards) corners = {corners.rbegin(), corners.rend()};
                face(material(std::cos(kPrecisePi * (ring + 0.5) / rings)), corners);
            }
    }
    /// Writes NAME.obj, NAME.mtl and NAME.json with these further members of the scene; returns the path of the last.
    std::string write(const TempDir& folder, const std::string& name, const std::string& members) const {
        write_all(folder / (name + ".obj"), "mtllib " + name + ".mtl\n" + obj_.str());
        write_all(folder / (name + ".mtl"), mtl_.str());
        write_all(folder / (name + ".json"),
                  R"({"schema": "pathlight.scene/1", "obj": ")" + name + R"(.obj", )" + members + "}");
        return folder / (name + ".json");
    }

private:
    std::ostringstream obj_ = precise();
    std::ostringstream mtl_ = precise();

    static std::ostringstream precise() {
        std::ostringstream stream;
        stream.precision(9);
        return stream;
    }
};

/// A camera member that sees one point.
inline std::string looking(Point eye, Point target, double fov_deg = 0.05) {
    std::ostringstream text;
    const auto vector = [](const Point& p) {
        std::ostringstream words;
        words << '[' << p[0] << ',' << p[1] << ',' << p[2] << ']';
        return words.str();
    };
    text << R"("camera": {"eye": )" << vector(eye) << R"(, "target": )" << vector(target)
         << R"(, "up": [0.01, 0.02, 1], "fov_deg": )" << fov_deg << "}";
    return text.str();
}

}  // namespace pl::test
