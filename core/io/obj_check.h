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
#include "core/io/tally.h"

namespace pl {

/// Areas must fit in a float.
inline constexpr double kLargestCoordinate = 1e18;
inline constexpr std::size_t kMostCorners = 65536;  ///< of a face
/// In the place of an index that cannot be used.
inline constexpr std::int64_t kUnusableIndex = std::numeric_limits<std::int32_t>::max();
/// Most vertices, normals or texture points.
inline constexpr std::int64_t kMostElements = kUnusableIndex - 1;

/// Whether a statement is known and changes nothing, with any arguments.
bool is_without_effect(std::string_view keyword);

/// The vertices, normals or texture points of a file.
struct CheckedElements {
    const char* name;
    std::int64_t count = 0;
    std::vector<std::int64_t> unusable{};  ///< indices of those without usable numbers, ascending
    Tally malformed{};                     ///< these
    std::string first_fault{};             ///< of the first index that is kUnusableIndex in the text

    /// Why no face can use the element of an absolute index; empty: it can.
    std::string fault_of(std::int64_t index) const;
};

/// An OBJ text that is safe for the library: only `v x y z`, `vn x y z`, `vt u v`, `f` with absolute indices (`v`, `v/t`, `v//n` or
/// `v/t/n` per corner, at least three), and `usemtl` with a name encoded by encode_name(). Numbers are
/// rounded to float here and written with nine digits, which the library reads as that float; it rounds long ones
/// inexactly. Elements without usable numbers are zeros, and indices may be out of range: CheckedElements::fault_of() tells.
struct CheckedObj {
    std::string text;
    std::vector<int> face_lines;                ///< line in the file, per `f` of `text`
    std::vector<std::uint32_t> face_groups;     ///< index into `group_names`, per `f` of `text`
    std::vector<Smoothing> face_smoothing;      ///< per `f` of `text`
    std::vector<std::string> group_names;       ///< arguments of `o` and `g` statements; first: faces before any
    std::vector<ObjName> libraries;             ///< arguments of each `mtllib`
    std::map<std::string, int> material_lines;  ///< name -> line of its first `usemtl`
    CheckedElements vertices{.name = "vertex"};
    CheckedElements normals{.name = "normal"};
    CheckedElements texture_points{.name = "texture point"};
    Tally short_faces;  ///< of fewer than three corners, which are not in `text`
    std::vector<std::string> warnings;
};

/// Indices may refer to later elements; negative ones count back from the face. Throws Error(Input) with file and line for a control
/// character and for more than kMostElements elements. Vertices of the text are relative to `origin`.
CheckedObj check_obj(std::string_view text, const std::filesystem::path& path, const glm::dvec3& origin);

/// Encodes a name with blanks as one word, because functions of the library treat blanks differently. decode_name()
/// gives a space for a tab.
std::string encode_name(std::string_view name);
std::string decode_name(std::string_view word);

}  // namespace pl
