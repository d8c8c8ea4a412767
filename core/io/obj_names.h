// Names of materials and files in OBJ and MTL text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pl {

/// A name without the quotes that some programs write around it; behind these may be a comment.
std::string_view unquoted(std::string_view name);

/// The name of a material in the arguments of `usemtl` and `newmtl`: a tab in it counts as a space.
std::string material_name(std::string_view arguments);

/// The file names in the arguments of `mtllib`: each in quotes, or up to a word that ends with .mtl, or a word.
std::vector<std::string> library_names(std::string_view arguments);

/// A file that a scene names.
struct NamedFile {
    std::filesystem::path path;  ///< where it was looked for last, if it is not there
    bool is_there = true;
    bool is_elsewhere = false;  ///< it is, or would have to be, in another place than the named one
};

/// The file of a name, with slashes of either kind, in a text in the folder `root / from`. Nothing but `root` and below is looked at, and
/// for images, which programs write into a folder beside the folder of the OBJ file, the folder above: of a name that
/// is absolute, leads elsewhere, or has no file, the longest end that has one in `from` or `root` counts.
NamedFile find_named_file(const std::filesystem::path& root, const std::filesystem::path& from, std::string_view name,
                          bool is_image = false);

}  // namespace pl
