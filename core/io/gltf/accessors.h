// Elements of accessors: typed, strided, quantized and sparse views of the buffers. [glTF 2.0, section 3.6.2]
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/io/gltf/gltf_file.h"

namespace pl {

/// Most elements of an accessor without a buffer view, whose memory no byte of the file pays for.
inline constexpr std::uint64_t kMostZeroElements = std::uint64_t{1} << 22;

/// Number of elements.
std::uint64_t accessor_count(const GltfFile& file, std::uint32_t accessor);

/// [element][component] as floats; normalized integers in [0, 1] or [-1, 1]. `type` is "VEC3" or the like.
/// Throws Error(Input): another type, elements beyond the buffer view, numbers that are not finite.
std::vector<float> read_floats(GltfFile& file, std::uint32_t accessor, std::string_view type);

/// [element][component] of unsigned integers.
std::vector<std::uint32_t> read_integers(GltfFile& file, std::uint32_t accessor, std::string_view type);

/// Type of an accessor, such as "VEC4".
std::string accessor_type(const GltfFile& file, std::uint32_t accessor);

}  // namespace pl
