// A part of an OBJ text that ends at the end of a statement, read independently of the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/name_index.h"
#include "core/io/obj_mesh.h"
#include "core/io/tally.h"

namespace pl {

/// The lists whose elements the corners of faces name: vertices, normals and texture points, in this order.
inline constexpr std::size_t kObjLists = 3;
inline constexpr std::array<const char*, kObjLists> kObjElementNames = {"vertex", "normal", "texture point"};
/// Most elements of a list: more than that, an index of OBJ programs cannot name.
inline constexpr std::int64_t kMostElements = std::numeric_limits<std::int32_t>::max() - 1;
inline constexpr std::size_t kMostCorners = 65536;  ///< of a face

/// Numbers of elements and lines.
struct ObjCounts {
    std::array<std::int64_t, kObjLists> elements{};
    std::int64_t faces = 0;
    std::int64_t lines = 0;

    ObjCounts& operator+=(const ObjCounts& more) {
        for (std::size_t list = 0; list < kObjLists; ++list) elements[list] += more.elements[list];
        faces += more.faces;
        lines += more.lines;
        return *this;
    }
};

ObjCounts count_elements(std::string_view text);

/// Numbers, from 1, of the elements of each list that have no usable coordinates, ascending.
using UnusableElements = std::array<std::vector<std::int64_t>, kObjLists>;

/// What is left out or corrected.
struct ObjTallies {
    Tally short_faces{};  ///< of fewer than three corners
    Tally colors{};
    Tally weights{};
    Tally unknown{};
    std::array<Tally, kObjLists> malformed{};
    Tally unusable_faces{};
    Tally unusable_corners{};  ///< faces shown without normals or texture points

    /// Adds those of the next chunk.
    void add(const ObjTallies& later);
    std::vector<std::string> warnings(const std::filesystem::path& path) const;
};

/// Reads one chunk, into arrays of the mesh that have their size already, and into lists of its own. Lines as most programs write them
/// take a quick way; in others every word is looked at.
class ObjChunkReader {
public:
    /// `before`: elements of the chunks before this one; `total`: those of the file.
    ObjChunkReader(ObjMesh& mesh, const std::filesystem::path& path, const ObjCounts& before, const ObjCounts& total);

    /// Throws Error(Input) with file and line for a control character and for more than kMostElements elements.
    void read(std::string_view text, std::int64_t face_count);

    /// Second step, when read() has seen all chunks: the faces with something to correct or to report, and those with elements of
    /// which the file says later that they are unusable. The text that was read must still be there.
    void check_faces(const UnusableElements& unusable);

    /// Materials and groups of the runs are numbers of this chunk's own lists, or kInherited; their smoothing may be inherited.
    ObjFaces take_faces() { return std::move(faces_); }
    const std::vector<ObjName>& materials() const { return materials_; }
    const std::vector<std::string>& groups() const { return groups_; }
    const std::vector<ObjName>& libraries() const { return libraries_; }
    const UnusableElements& unusable() const { return unusable_; }
    const ObjTallies& tallies() const { return tallies_; }

    /// The material or group of the last run of the chunk before.
    static constexpr std::uint32_t kInherited = 0xfffffffeu;

    /// A face that read() has put off: the face of that number has no corners yet.
    struct OddFace {
        std::size_t face = 0;
        std::string_view statement{};
        std::array<std::int64_t, kObjLists> so_far{};  ///< elements before the face
    };

private:
    bool read_simple(std::string_view keyword, std::string_view arguments);
    bool read_simple_element(std::size_t list, std::string_view arguments);
    bool read_simple_face(std::string_view arguments);
    bool read_simple_corner(const char*& at, const char* end, ObjCorner& corner) const;
    void read_any(std::string_view keyword, std::string_view arguments, std::string_view statement);
    void read_element(std::size_t list, std::string_view arguments);
    void add_element(std::size_t list, const glm::vec3& values);
    void add_face(std::uint32_t corner_count, int line);
    void tell_faults(const std::array<std::string, kObjLists>& faults, int line);
    ObjFaces::Run& start_run();

    ObjMesh& mesh_;
    const std::filesystem::path& path_;
    ObjCounts at_;  ///< before the statement
    const ObjCounts& total_;
    ObjFaces faces_;
    std::vector<OddFace> odd_faces_;
    std::vector<ObjName> materials_;
    std::vector<std::string> groups_;
    std::vector<ObjName> libraries_;
    NameIndex material_index_;
    NameIndex group_index_;
    UnusableElements unusable_{};
    ObjTallies tallies_{};
    int line_ = 0;  ///< of the start of the statement
};

}  // namespace pl
