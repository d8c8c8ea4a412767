// Triangles of Mitsuba's compressed mesh files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/io/mitsuba/ply.h"

namespace pl {

/// Reads the shape of this number from a file of version 3 or 4: positions, normals and texture coordinates, as floats or doubles;
/// colors are passed over. [Mitsuba 0.6, section 8.1.6]
/// Throws Error(Input): no such file or shape, damaged, more than kMostSerializedBytes unpacked, indices out of range, numbers that
/// are not finite.
PlyMesh read_serialized(const std::filesystem::path& path, std::int64_t shape);

inline constexpr std::size_t kMostSerializedBytes = std::size_t{1} << 30;

}  // namespace pl
