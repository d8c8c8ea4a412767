#include "core/io/obj_chunk.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/io/obj_check.h"
#include "core/io/obj_names.h"

namespace pl {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

const char* skip_blanks(const char* at, const char* end) {
    while (at != end && is_blank(*at)) {
        ++at;
    }
    return at;
}

const char* skip_word(const char* at, const char* end) {
    while (at != end && !is_blank(*at)) {
        ++at;
    }
    return at;
}

/// Whether text of a name, a comment or a statement without effect may be read as a line of its own.
bool is_plain(const char* at, const char* end) {
    return std::none_of(at, end, [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return (code < 0x20 && c != '\t') || code == 0x7f;
    });
}

/// Calls visit(keyword, arguments, end of the line) for every line; the keyword of a comment is empty, as that of a line of
/// blanks. Stops and returns false if a visit does.
template <class Visit>
bool for_each_line(std::string_view text, Visit&& visit) {
    const char* at = text.data();
    const char* const text_end = at + text.size();
    while (at != text_end) {
        const void* const found = std::memchr(at, '\n', static_cast<std::size_t>(text_end - at));
        const char* const line_end = found != nullptr ? static_cast<const char*>(found) : text_end;
        const bool has_return = found != nullptr && line_end != at && line_end[-1] == '\r';
        const char* const end = has_return ? line_end - 1 : line_end;
        const char* const keyword = skip_blanks(at, end);
        const bool is_comment = keyword != end && *keyword == '#';
        const char* const keyword_end = is_comment ? keyword : skip_word(keyword, end);
        if (!visit(std::string_view(keyword, static_cast<std::size_t>(keyword_end - keyword)), keyword_end, end)) {
            return false;
        }
        at = found != nullptr ? line_end + 1 : text_end;
    }
    return true;
}

/// An index that counts from 1, or back from the last of the `so_far` elements.
bool read_index(const char*& at, const char* end, std::int64_t so_far, std::int64_t total, std::uint32_t& index) {
    std::int32_t value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    at = stop;
    index = static_cast<std::uint32_t>(value > 0 ? value - 1 : so_far + value);
    return error == std::errc{} && value != 0 && value >= -so_far && value <= total;
}

/// Reads up to `most` numbers, which must fill the line, less `origin`, which are at least three or null; returns how many, or -1.
int numbers(const char* at, const char* end, float* values, int most, const double* origin = nullptr) {
    int count = 0;
    for (at = skip_blanks(at, end); at != end; at = skip_blanks(at, end)) {
        double value = 0.0;
        const auto [stop, error] = std::from_chars(at, end, value);
        const bool is_word = stop == end || is_blank(*stop);
        if (count == most || error != std::errc{} || !is_word || !(std::abs(value) <= kLargestCoordinate)) {
            return -1;
        }
        values[count] = static_cast<float>(origin != nullptr ? value - origin[count] : value);
        ++count;
        at = stop;
    }
    return count;
}

}  // namespace

ObjCounts count_elements(std::string_view text) {
    ObjCounts counts;
    for_each_line(text, [&](std::string_view keyword, const char*, const char*) {
        ++counts.lines;
        counts.vertices += keyword == "v" ? 1 : 0;
        counts.normals += keyword == "vn" ? 1 : 0;
        counts.uvs += keyword == "vt" ? 1 : 0;
        counts.faces += keyword == "f" ? 1 : 0;
        return true;
    });
    return counts;
}

ObjChunkReader::ObjChunkReader(ObjMesh& mesh, const ObjCounts& before, const ObjCounts& total)
    : mesh_(mesh), at_(before), total_(total) {
    faces_.runs.push_back({0, kInherited, kInherited, Smoothing::Inherited});
}

bool ObjChunkReader::read(std::string_view text, std::int64_t face_count) {
    const auto faces = static_cast<std::size_t>(face_count);
    faces_.corners.reserve(std::min(3 * faces, text.size() / 2));  // a corner takes two characters at least
    faces_.corner_counts.reserve(faces);
    faces_.lines.reserve(faces);
    return for_each_line(text, [this](std::string_view keyword, const char* at, const char* end) {
        ++at_.lines;
        return statement(keyword, at, end);
    });
}

bool ObjChunkReader::statement(std::string_view keyword, const char* at, const char* end) {
    if (keyword == "v") {
        glm::vec3& position = mesh_.positions[static_cast<std::size_t>(at_.vertices++)];
        return numbers(at, end, &position.x, 3, &mesh_.origin.x) == 3;
    }
    if (keyword == "f") {
        return face(at, end);
    }
    if (keyword == "vn") {
        glm::vec3& normal = mesh_.normals[static_cast<std::size_t>(at_.normals++)];
        return numbers(at, end, &normal.x, 3) == 3;
    }
    if (keyword == "vt") {
        float values[3]{};
        const int count = numbers(at, end, values, 3);
        mesh_.uvs[static_cast<std::size_t>(at_.uvs++)] = {values[0], count > 1 ? values[1] : 0.0f};
        return count >= 1;
    }
    return is_plain(at, end) && (keyword.empty() || (end[-1] != '\\' && other_statement(keyword, at, end)));
}

bool ObjChunkReader::face(const char* at, const char* end) {
    const std::size_t first = faces_.corners.size();
    for (at = skip_blanks(at, end); at != end; at = skip_blanks(at, end)) {
        ObjCorner corner;
        if (!read_corner(at, end, corner)) {
            return false;
        }
        faces_.corners.push_back(corner);
    }
    const std::size_t count = faces_.corners.size() - first;
    faces_.corner_counts.push_back(static_cast<std::uint32_t>(count));
    faces_.lines.push_back(static_cast<int>(at_.lines));
    return count >= 3 && count <= kMostCorners;
}

/// `v`, `v/t`, `v//n` or `v/t/n`; moves `at` behind it.
bool ObjChunkReader::read_corner(const char*& at, const char* end, ObjCorner& corner) const {
    const auto is_slash = [&] { return at != end && *at == '/'; };
    if (!read_index(at, end, at_.vertices, total_.vertices, corner.vertex)) {
        return false;
    }
    if (is_slash()) {
        ++at;
        if (!is_slash() && !read_index(at, end, at_.uvs, total_.uvs, corner.uv)) {
            return false;
        }
        if (is_slash() && !read_index(++at, end, at_.normals, total_.normals, corner.normal)) {
            return false;
        }
    }
    return at == end || is_blank(*at);
}

bool ObjChunkReader::other_statement(std::string_view keyword, const char* at, const char* end) {
    at = skip_blanks(at, end);
    while (end != at && is_blank(end[-1])) {
        --end;
    }
    const std::string arguments(at, end);
    if (keyword == "usemtl") {
        const std::string name = material_name(arguments);
        start_run().material = material_index_.find_or(name, [&] {
            materials_.push_back({name, static_cast<int>(at_.lines)});
        });
    } else if (keyword == "o" || keyword == "g") {
        start_run().group = group_index_.find_or(arguments, [&] { groups_.push_back(arguments); });
    } else if (keyword == "s") {
        start_run().smoothing = smoothing_of(arguments);
    } else if (keyword == "mtllib") {
        libraries_.push_back({arguments, static_cast<int>(at_.lines)});
    } else {
        return is_without_effect(keyword);
    }
    return true;
}

/// The run of the faces from here on.
ObjFaces::Run& ObjChunkReader::start_run() {
    if (faces_.runs.back().first != faces_.size()) {
        faces_.runs.push_back(faces_.runs.back());
        faces_.runs.back().first = faces_.size();
    }
    return faces_.runs.back();
}

}  // namespace pl
