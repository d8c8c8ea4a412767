// Second reading of a part of an OBJ text: faces, and the statements that say how they look.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/obj_elements.h"
#include "core/io/obj_mesh.h"
#include "core/io/tally.h"

namespace pl {

// The number of a name in a list of different ones.

/// The number of a name in a list, to which it is added if it is new.
class NameIndex {
public:
    /// Calls add() for a new name.
    template <class Add>
    std::uint32_t find_or(const std::string& name, Add&& add) {
        const auto [entry, is_new] = index_.try_emplace(name, static_cast<std::uint32_t>(index_.size()));
        if (is_new) {
            add();
        }
        return entry->second;
    }

private:
    std::map<std::string, std::uint32_t> index_;
};

/// Faces and statements that cannot be used as they are.
struct ObjFaceTallies {
    Tally short_faces;  ///< of fewer than three corners
    Tally unknown;
    Tally unusable_faces;
    Tally unusable_corners;  ///< faces shown without normals or texture points

    /// Adds the tallies of the part of the text that follows.
    void add(const ObjFaceTallies& later);
};

/// Reads one part into lists of its own.
class ObjFaceReader {
public:
    /// `all`: of the whole text, which the reader refers to; `before`: what precedes the part.
    ObjFaceReader(const ObjElements& all, const ObjCounts& before);

    /// `face_count`: faces of the text. Lines of messages are of the file.
    void read(std::string_view text, std::size_t face_count);

    /// Materials and groups of the runs are numbers of this part's own lists, or kInherited; their smoothing may be inherited.
    ObjFaces take_faces() { return std::move(faces_); }
    const std::vector<ObjName>& materials() const { return materials_; }
    const std::vector<std::string>& groups() const { return groups_; }
    const std::vector<ObjName>& libraries() const { return libraries_; }
    const ObjFaceTallies& tallies() const { return tallies_; }

    /// The material or group of the last run of the part before.
    static constexpr std::uint32_t kInherited = 0xfffffffeu;

private:
    void read_face(std::string_view arguments);
    const char* read_usual_corner(const char* at, const char* end, ObjCorner& corner) const;
    ObjCorner read_corner(std::string_view word);
    std::uint32_t read_index(ObjList list, std::string_view part, std::string_view word);
    void check_usable(const ObjCorner& corner);
    void fault(std::size_t list, const std::string& what);
    bool keep_faulty_face(std::size_t first);
    void read_look(std::string_view keyword, std::string_view arguments);
    ObjFaces::Run& start_run();

    const ObjElements& all_;
    bool are_all_usable_;
    std::array<std::size_t, kObjLists> so_far_;  ///< elements before the statement
    int line_;                                   ///< of the statement
    ObjFaces faces_;
    std::array<std::string, kObjLists> faults_;  ///< of the face: the first one of each list, or empty
    bool is_faulty_ = false;
    std::vector<ObjName> materials_;
    std::vector<std::string> groups_;
    std::vector<ObjName> libraries_;
    NameIndex material_index_;
    NameIndex group_index_;
    ObjFaceTallies tallies_;
};

}  // namespace pl
