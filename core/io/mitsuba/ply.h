// Triangles of PLY files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Content of a PLY file, or of a shape in a serialized file.
struct PlyMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  ///< per vertex, or none
    std::vector<glm::vec2> uvs;      ///< per vertex, or none
    std::vector<glm::vec3> colors;   ///< per vertex, integers as shares of their largest; or none
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< polygons are cut as fans
    bool is_flat = false;                                 ///< a serialized file says that its faces are flat
};

/// Reads text and binary files of either order of bytes. Elements other than `vertex` and `face`, and other properties, are passed
/// over. Throws Error(Input) with the byte: a header that is none, counts beyond the file, indices out of range, numbers that are not
/// finite.
PlyMesh read_ply(const std::filesystem::path& path);

}  // namespace pl
