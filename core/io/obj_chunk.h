// A part of an OBJ text that ends at the end of a line, read independently of the others.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/name_index.h"
#include "core/io/obj_mesh.h"

namespace pl {

/// Numbers of elements and lines.
struct ObjCounts {
    std::int64_t vertices = 0;
    std::int64_t normals = 0;
    std::int64_t uvs = 0;
    std::int64_t faces = 0;
    std::int64_t lines = 0;

    ObjCounts& operator+=(const ObjCounts& more) {
        vertices += more.vertices;
        normals += more.normals;
        uvs += more.uvs;
        faces += more.faces;
        lines += more.lines;
        return *this;
    }
};

ObjCounts count_elements(std::string_view text);

/// Reads one chunk, into arrays of the mesh that have their size already, and into lists of its own.
class ObjChunkReader {
public:
    /// `before`: elements of the chunks before this one; `total`: those of the file.
    ObjChunkReader(ObjMesh& mesh, const ObjCounts& before, const ObjCounts& total);

    /// False if the text is not simple.
    bool read(std::string_view text, std::int64_t face_count);

    /// Materials and groups of the runs are numbers of this chunk's own lists, or kInherited; their smoothing may be inherited.
    ObjFaces take_faces() { return std::move(faces_); }
    const std::vector<ObjName>& materials() const { return materials_; }
    const std::vector<std::string>& groups() const { return groups_; }
    const std::vector<ObjName>& libraries() const { return libraries_; }

    /// The material or group of the last run of the chunk before.
    static constexpr std::uint32_t kInherited = 0xfffffffeu;

private:
    bool statement(std::string_view keyword, const char* at, const char* end);
    bool face(const char* at, const char* end);
    bool read_corner(const char*& at, const char* end, ObjCorner& corner) const;
    bool other_statement(std::string_view keyword, const char* at, const char* end);
    ObjFaces::Run& start_run();

    ObjMesh& mesh_;
    ObjCounts at_;  ///< so far
    const ObjCounts& total_;
    ObjFaces faces_;
    std::vector<ObjName> materials_;
    std::vector<std::string> groups_;
    std::vector<ObjName> libraries_;
    NameIndex material_index_;
    NameIndex group_index_;
};

}  // namespace pl
