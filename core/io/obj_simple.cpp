#include "core/io/obj_simple.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

#include "core/base/parallel_chunks.h"
#include "core/io/obj_check.h"

namespace pl {

namespace {

/// State that a chunk takes over from the one before.
constexpr std::uint32_t kInherited = 0xfffffffeu;

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

/// Calls visit(keyword, arguments, end of the line) for every line that is not empty, without blanks in front; an empty
/// keyword stands for a comment. Stops and returns false if a visit does.
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

/// The number of a name in a list, to which it is added if it is new.
class NameIndex {
public:
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

/// Reads one chunk, into arrays of the mesh that have their size already, and into lists of its own.
class ObjChunkReader {
public:
    /// `before`: elements of the chunks before this one; `total`: those of the file.
    ObjChunkReader(ObjMesh& mesh, const ObjCounts& before, const ObjCounts& total)
        : mesh_(mesh), at_(before), total_(total) {
        faces_.runs.push_back({0, kInherited, kInherited});
    }

    /// False if the text is not simple.
    bool read(std::string_view text, std::int64_t face_count) {
        faces_.corners.reserve(3 * static_cast<std::size_t>(face_count));
        faces_.corner_counts.reserve(static_cast<std::size_t>(face_count));
        faces_.lines.reserve(static_cast<std::size_t>(face_count));
        return for_each_line(text, [this](std::string_view keyword, const char* at, const char* end) {
            ++at_.lines;
            return statement(keyword, at, end);
        });
    }

    ObjFaces take_faces() { return std::move(faces_); }
    const std::vector<ObjName>& materials() const { return materials_; }
    const std::vector<std::string>& groups() const { return groups_; }
    const std::vector<ObjName>& libraries() const { return libraries_; }

private:
    bool statement(std::string_view keyword, const char* at, const char* end) {
        if (keyword == "v") {
            glm::vec3& position = mesh_.positions[static_cast<std::size_t>(at_.vertices++)];
            return numbers(at, end, &position.x, 3) == 3;
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

    /// Reads up to `most` numbers, which must fill the line; returns how many, or -1.
    static int numbers(const char* at, const char* end, float* values, int most) {
        int count = 0;
        for (at = skip_blanks(at, end); at != end; at = skip_blanks(at, end)) {
            double value = 0.0;
            const auto [stop, error] = std::from_chars(at, end, value);
            const bool is_word = stop == end || is_blank(*stop);
            if (count == most || error != std::errc{} || !is_word || !(std::abs(value) <= kLargestCoordinate)) {
                return -1;
            }
            values[count++] = static_cast<float>(value);
            at = stop;
        }
        return count;
    }

    bool face(const char* at, const char* end) {
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
    bool read_corner(const char*& at, const char* end, ObjCorner& corner) const {
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

    /// An index that counts from 1, or back from the last of the `so_far` elements.
    static bool read_index(const char*& at, const char* end, std::int64_t so_far, std::int64_t total,
                           std::uint32_t& index) {
        std::int32_t value = 0;
        const auto [stop, error] = std::from_chars(at, end, value);
        at = stop;
        index = static_cast<std::uint32_t>(value > 0 ? value - 1 : so_far + value);
        return error == std::errc{} && value != 0 && value >= -so_far && value <= total;
    }

    bool other_statement(std::string_view keyword, const char* at, const char* end) {
        at = skip_blanks(at, end);
        while (end != at && is_blank(end[-1])) {
            --end;
        }
        const std::string arguments(at, end);
        if (keyword == "usemtl") {
            const std::string name = decode_name(encode_name(arguments));
            start_run().material = material_index_.find_or(name, [&] {
                materials_.push_back({name, static_cast<int>(at_.lines)});
            });
        } else if (keyword == "o" || keyword == "g") {
            start_run().group = group_index_.find_or(arguments, [&] { groups_.push_back(arguments); });
        } else if (keyword == "mtllib") {
            libraries_.push_back({arguments, static_cast<int>(at_.lines)});
        } else {
            return is_without_effect(keyword);
        }
        return true;
    }

    /// The run of the faces from here on.
    ObjFaces::Run& start_run() {
        if (faces_.runs.back().first != faces_.size()) {
            faces_.runs.push_back(faces_.runs.back());
            faces_.runs.back().first = faces_.size();
        }
        return faces_.runs.back();
    }

    ObjMesh& mesh_;
    ObjCounts at_;  ///< so far
    const ObjCounts& total_;
    ObjFaces faces_;  ///< materials and groups of the runs are numbers of this chunk's own lists, or kInherited
    std::vector<ObjName> materials_;
    std::vector<std::string> groups_;
    std::vector<ObjName> libraries_;
    NameIndex material_index_;
    NameIndex group_index_;
};

/// Joins what the chunks have found, in the order of the file.
class ObjChunkJoiner {
public:
    explicit ObjChunkJoiner(ObjMesh& mesh) : mesh_(mesh) {
        group_index_.find_or("", [&] { mesh_.groups.emplace_back(); });
    }

    void add(ObjChunkReader& chunk) {
        std::vector<std::uint32_t> materials;
        for (const ObjName& material : chunk.materials()) {
            materials.push_back(material_index_.find_or(material.name, [&] { mesh_.materials.push_back(material); }));
        }
        std::vector<std::uint32_t> groups;
        for (const std::string& group : chunk.groups()) {
            groups.push_back(group_index_.find_or(group, [&] { mesh_.groups.push_back(group); }));
        }
        mesh_.libraries.insert(mesh_.libraries.end(), chunk.libraries().begin(), chunk.libraries().end());
        ObjFaces faces = chunk.take_faces();
        const ObjFaces::Run before = last_;
        for (ObjFaces::Run& run : faces.runs) {
            run.material = run.material == kInherited ? before.material : materials[run.material];
            run.group = run.group == kInherited ? before.group : groups[run.group];
            last_ = run;
        }
        mesh_.parts.push_back(std::move(faces));
    }

private:
    ObjMesh& mesh_;
    NameIndex material_index_;
    NameIndex group_index_;
    ObjFaces::Run last_;
};

/// Parts of about `bytes` that end at ends of lines.
std::vector<std::string_view> split_at_lines(std::string_view text, std::size_t bytes) {
    std::vector<std::string_view> chunks;
    while (!text.empty()) {
        const std::size_t end = text.size() > bytes ? text.find('\n', bytes - 1) : std::string_view::npos;
        const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
        chunks.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return chunks;
}

/// Elements before each chunk and, last, all of them.
std::vector<ObjCounts> count_before(const std::vector<std::string_view>& chunks, int threads) {
    std::vector<ObjCounts> before(chunks.size() + 1);
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads,
               [&](IndexRange range) { before[range.begin + 1] = count_elements(chunks[range.begin]); });
    for (std::size_t i = 1; i < before.size(); ++i) {
        before[i] += before[i - 1];
    }
    return before;
}

bool is_readable(const ObjCounts& total) {
    return total.faces > 0 && std::max({total.vertices, total.normals, total.uvs, total.lines}) <= kMostElements;
}

}  // namespace

std::optional<ObjMesh> read_simple_obj(std::string_view text, int threads, std::size_t chunk_bytes) {
    const std::vector<std::string_view> chunks = split_at_lines(text, chunk_bytes);
    const std::vector<ObjCounts> before = count_before(chunks, threads);
    const ObjCounts& total = before.back();
    if (!is_readable(total)) {
        return std::nullopt;
    }
    ObjMesh mesh;
    mesh.positions.resize(static_cast<std::size_t>(total.vertices));
    mesh.normals.resize(static_cast<std::size_t>(total.normals));
    mesh.uvs.resize(static_cast<std::size_t>(total.uvs));
    std::vector<ObjChunkReader> readers;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        readers.emplace_back(mesh, before[i], total);
    }
    std::atomic<bool> is_simple{true};
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads, [&](IndexRange range) {
        const std::uint32_t i = range.begin;
        if (is_simple && !readers[i].read(chunks[i], before[i + 1].faces - before[i].faces)) {
            is_simple = false;
        }
    });
    if (!is_simple) {
        return std::nullopt;
    }
    ObjChunkJoiner joiner(mesh);
    for (ObjChunkReader& reader : readers) {
        joiner.add(reader);
    }
    return mesh;
}

}  // namespace pl
