// The rules of an OBJ text, checked before the OBJ library sees it: the library reads indices without looking at
// the number of vertices, and turns what it cannot read into zeros.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pl {

/// Names after one `mtllib`, as written.
struct MaterialLibraries {
    std::string names;
    int line = 0;
};

/// An OBJ text that is safe to hand on: only `v x y z`, `vn x y z`, `vt u v`, `f` with absolute indices in range
/// (`v`, `v/t`, `v//n` or `v/t/n` per corner, at least three), and `usemtl` with a name encoded by encode_name().
struct CheckedObj {
    std::string text;
    std::vector<int> face_lines;               ///< line in the file of each `f` in `text`
    std::vector<std::uint32_t> face_groups;    ///< of each `f` in `text`: index into `group_names`
    std::vector<std::string> group_names{""};  ///< of `o` and `g` statements; first: faces before any
    std::vector<MaterialLibraries> libraries;
    std::map<std::string, int> material_lines;  ///< name -> line of its first `usemtl`
    std::vector<std::string> warnings;
};

/// Throws Error(Input) with file and line: a number that is none or is not finite, a coordinate beyond 1e18 (areas
/// must fit in a float), an index that is 0 or out of range, a face of more than 65536 corners, no face at all.
/// Indices may point to vertices that follow; negative ones count back from the face.
CheckedObj check_obj(std::string_view text, const std::filesystem::path& path);

/// A name as one word, whatever blanks it has: the library's functions disagree about blanks. A tab comes back as a
/// space.
std::string encode_name(std::string_view name);
std::string decode_name(std::string_view word);

}  // namespace pl
