// Reader of OBJ text without anything to correct or to report, by several threads.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/io/obj_mesh.h"

namespace pl {

/// Bytes of text that a thread reads at once.
inline constexpr std::size_t kObjChunk = std::size_t{1} << 20;

/// Reads a text that consists of `v` with three numbers, `vn`, `vt`, faces with indices in range, `usemtl`, `mtllib`,
/// `o`, `g`, statements without effect, comments and empty lines, in the order of any OBJ file. The result is that of
/// check_obj() and the OBJ library on the same text, to the bit, for any number of threads and size of chunks.
/// Nothing if there is anything else in the text: an error, a statement to warn of, a continued line, a plus sign. Those
/// readers then name it. `origin`: that of the mesh.
std::optional<ObjMesh> read_simple_obj(std::string_view text, int threads, std::size_t chunk_bytes = kObjChunk,
                                       const glm::dvec3& origin = glm::dvec3(0.0));

}  // namespace pl
