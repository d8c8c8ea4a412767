// Validation of OBJ text before the OBJ library parses it: the library does not check indices against the number of
// vertices, and reads malformed numbers as zeros.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/obj_mesh.h"

namespace pl {

/// Areas must fit in a float.
inline constexpr double kLargestCoordinate = 1e18;
inline constexpr std::size_t kMostCorners = 65536;  ///< of a face
/// Most vertices, normals or texture points.
inline constexpr std::int64_t kMostElements = std::numeric_limits<std::int32_t>::max();

/// Whether a statement is known and changes nothing, with any arguments.
bool is_without_effect(std::string_view keyword);

/// An OBJ text that is safe for the library: only `v x y z`, `vn x y z`, `vt u v`, `f` with absolute indices in range
/// (`v`, `v/t`, `v//n` or `v/t/n` per corner, at least three), and `usemtl` with a name encoded by encode_name(). Numbers are
/// rounded to float here and written with nine digits, which the library reads as that float; it rounds long ones
/// inexactly.
struct CheckedObj {
    std::string text;
    std::vector<int> face_lines;                ///< line in the file, per `f` of `text`
    std::vector<std::uint32_t> face_groups;     ///< index into `group_names`, per `f` of `text`
    std::vector<Smoothing> face_smoothing;      ///< per `f` of `text`
    std::vector<std::string> group_names;       ///< arguments of `o` and `g` statements; first: faces before any
    std::vector<ObjName> libraries;             ///< arguments of each `mtllib`
    std::map<std::string, int> material_lines;  ///< name -> line of its first `usemtl`
    std::vector<std::string> warnings;
};

/// Throws Error(Input) with file and line: a malformed or non-finite number, a coordinate beyond
/// kLargestCoordinate, an index that is 0 or out of range, a face of more than 65536 corners, no face at all. Indices may
/// refer to later vertices; negative ones count back from the face.
CheckedObj check_obj(std::string_view text, const std::filesystem::path& path);

/// Encodes a name with blanks as one word, because functions of the library treat blanks differently. decode_name()
/// gives a space for a tab.
std::string encode_name(std::string_view name);
std::string decode_name(std::string_view word);

}  // namespace pl
