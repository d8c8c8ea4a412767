#include "core/io/obj_chunk.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/obj_names.h"
#include "core/io/triangle_area.h"

namespace pl {

namespace {

constexpr std::size_t kVertices = 0;
constexpr std::size_t kNormals = 1;
constexpr std::size_t kUvs = 2;
constexpr std::array<std::uint32_t ObjCorner::*, kObjLists> kIndexOf = {&ObjCorner::vertex, &ObjCorner::normal,
                                                                        &ObjCorner::uv};

/// The statement that adds to a list.
struct ElementForm {
    const char* keyword;
    std::size_t least;   ///< numbers that must be there
    std::size_t wanted;  ///< numbers that are read if they are there
};
constexpr std::array<ElementForm, kObjLists> kForms = {{{"v", 3, 3}, {"vn", 3, 3}, {"vt", 1, 2}}};

/// Statements that are known and change nothing, with any arguments.
constexpr std::array<std::string_view, 4> kWithoutEffect = {"l", "p", "vp", "mg"};

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

const char* find(char c, const char* begin, const char* end) {
    const void* const found = begin != end ? std::memchr(begin, c, static_cast<std::size_t>(end - begin)) : nullptr;
    return found != nullptr ? static_cast<const char*>(found) : end;
}

std::string_view between(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
}

/// Iterates over the statements of a text as LineReader does, which is slower because it looks for control characters. Comments and
/// empty lines have an empty keyword.
class StatementReader {
public:
    explicit StatementReader(std::string_view text)
        : at_(text.data()), end_(at_ + text.size()), feed_(find('\n', at_, end_)) {}

    /// False at the end of the text.
    bool next() {
        if (at_ == end_) {
            return false;
        }
        const char* const begin = at_;
        lines_ = 0;
        std::string_view line = take_line();
        const std::size_t first = line.find_first_not_of(" \t");
        const bool is_comment = first != std::string_view::npos && line[first] == '#';
        if (line.ends_with('\\') && !is_comment) {
            line = join(line);
        }
        const char* const line_end = line.data() + line.size();
        const char* const keyword = skip_blanks(line.data(), line_end);
        const char* const keyword_end = is_comment ? keyword : skip_word(keyword, line_end);
        keyword_ = between(keyword, keyword_end);
        arguments_ = between(keyword_end, line_end);
        text_ = between(begin, at_);
        return true;
    }

    std::string_view keyword() const { return keyword_; }
    std::string_view arguments() const { return arguments_; }  ///< the rest, with the blanks around it
    std::string_view text() const { return text_; }            ///< all of it, with the ends of its lines
    int lines() const { return lines_; }

private:
    std::string_view take_line() {
        if (feed_ < at_) {
            feed_ = find('\n', at_, end_);
        }
        const char* const stop = find('\r', at_, feed_);
        const std::string_view line = between(at_, stop);
        const char* const last = stop != end_ && stop + 1 == feed_ ? feed_ : stop;  // CR LF is one end
        at_ = last == end_ ? end_ : last + 1;
        ++lines_;
        return line;
    }

    /// A line that ends with a backslash, with those that continue it.
    std::string_view join(std::string_view line) {
        joined_.clear();
        while (line.ends_with('\\')) {
            joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
            line = take_line();
        }
        return joined_.append(line);
    }

    const char* at_;
    const char* end_;
    const char* feed_;  ///< the next '\n', or the end
    int lines_ = 0;
    std::string joined_;
    std::string_view keyword_;
    std::string_view arguments_;
    std::string_view text_;
};

/// The list that a statement adds to, or kObjLists.
std::size_t list_of(std::string_view keyword) {
    const auto found =
        std::find_if(kForms.begin(), kForms.end(), [&](const ElementForm& form) { return keyword == form.keyword; });
    return static_cast<std::size_t>(found - kForms.begin());
}

/// An index that counts from 1, or back from the last of the `so_far` elements.
bool read_simple_index(const char*& at, const char* end, std::int64_t so_far, std::int64_t total,
                       std::uint32_t& index) {
    std::int32_t value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    at = stop;
    index = static_cast<std::uint32_t>(value > 0 ? value - 1 : so_far + value);
    return error == std::errc{} && value != 0 && value >= -so_far && value <= total;
}

/// Reads up to three numbers, which must fill the text, less `origin`; returns how many, or 0.
std::size_t read_simple_numbers(std::string_view text, glm::vec3& values, const glm::dvec3& origin) {
    const char* const end = text.data() + text.size();
    int count = 0;
    for (const char* at = skip_blanks(text.data(), end); at != end; at = skip_blanks(at, end)) {
        double value = 0.0;
        const auto [stop, error] = std::from_chars(at, end, value);
        const bool is_word = stop == end || is_blank(*stop);
        if (count == 3 || error != std::errc{} || !is_word || !(std::abs(value) <= kLargestCoordinate)) {
            return 0;
        }
        values[count] = static_cast<float>(value - origin[count]);
        ++count;
        at = stop;
    }
    return static_cast<std::size_t>(count);
}

/// The first words as numbers less `origin`; returns why they are none, or an empty text.
std::string read_numbers(const std::vector<std::string_view>& words, const ElementForm& form, glm::vec3& values,
                         const glm::dvec3& origin) {
    if (words.size() < form.least) {
        return fmt::format("'{}': expected {} numbers, got {}", form.keyword, form.least, words.size());
    }
    for (std::size_t i = 0; i < std::min(words.size(), form.wanted); ++i) {
        const std::optional<double> value = parse_number(words[i]);
        if (!value || std::abs(*value) > kLargestCoordinate) {
            return fmt::format("'{}': expected finite numbers up to 1e18, got {}", form.keyword, in_quotes(words[i]));
        }
        const auto axis = static_cast<glm::length_t>(i);
        values[axis] = static_cast<float>(*value - origin[axis]);
    }
    return {};
}

/// The corners of a face, with why their indices into a list are not usable.
class FaceCheck {
public:
    explicit FaceCheck(const UnusableElements& unusable, const ObjCounts& total)
        : unusable_(unusable), total_(total) {}

    std::vector<ObjCorner> corners;
    std::array<std::string, kObjLists> faults;  ///< the first one of each list, or empty

    /// False if there are fewer than three.
    bool read(const ObjChunkReader::OddFace& face) {
        start();
        StatementReader reader(face.statement);
        reader.next();
        const std::vector<std::string_view> words = split_words(reader.arguments());
        if (words.size() < 3) {
            return false;
        }
        if (words.size() > kMostCorners) {
            faults[kVertices] =
                fmt::format("a face with {} corners: at most {} are supported", words.size(), kMostCorners);
            return true;
        }
        for (const std::string_view word : words) {
            corners.push_back(corner(word, face.so_far));
        }
        return true;
    }

    /// Takes a face whose indices are in range.
    void take(const ObjCorner* first, std::size_t count) {
        start();
        corners.assign(first, first + count);
        for (const ObjCorner& corner : corners) {
            for (std::size_t list = 0; list < kObjLists; ++list) {
                const std::uint32_t index = corner.*kIndexOf[list];
                if (index != ObjCorner::kNone) {
                    check_usable(list, std::int64_t{index} + 1);
                }
            }
        }
    }

    /// Drops the indices into lists of which one is not usable.
    void drop_faulty() {
        for (std::size_t list = 0; list < kObjLists; ++list) {
            for (std::size_t i = 0; i < corners.size() && !faults[list].empty(); ++i) {
                corners[i].*kIndexOf[list] = ObjCorner::kNone;
            }
        }
    }

private:
    void start() {
        corners.clear();
        faults.fill({});
    }

    /// `v`, `v/t`, `v//n` or `v/t/n`; programs write slashes without an index behind them, too.
    ObjCorner corner(std::string_view word, const std::array<std::int64_t, kObjLists>& so_far) {
        const std::size_t first = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', first + 1), word.size());
        const auto part = [&](std::size_t from, std::size_t to) {
            return from < to ? word.substr(from, to - from) : std::string_view{};
        };
        const std::array<std::string_view, kObjLists> parts = {part(0, first), part(second + 1, word.size()),
                                                               part(first + 1, second)};
        ObjCorner corner;
        for (std::size_t list = 0; list < kObjLists; ++list) {
            corner.*kIndexOf[list] = index(list, parts[list], word, so_far[list]);
        }
        if (parts[kVertices].empty()) {
            fault(kVertices,
                  fmt::format("expected a face corner such as 1, 1/2, 1//3 or 1/2/3, got {}", in_quotes(word)));
        }
        return corner;
    }

    /// kNone for an empty part, and for one with a fault.
    std::uint32_t index(std::size_t list, std::string_view part, std::string_view word, std::int64_t so_far) {
        if (part.empty()) {
            return ObjCorner::kNone;
        }
        const char* const name = kObjElementNames[list];
        const std::optional<std::int64_t> value = parse_integer(part);
        if (!value) {
            return fault(list, fmt::format("face corner {}: {} is not an index of a {}", in_quotes(word),
                                           in_quotes(part), name));
        }
        if (*value == 0) {
            return fault(list, fmt::format("face corner {}: {} index 0, indices start at 1", in_quotes(word), name));
        }
        if (*value < -so_far) {
            return fault(list, fmt::format("face corner {}: {} index {} is out of range, {} precede the face",
                                           in_quotes(word), name, *value, so_far));
        }
        if (*value > kMostElements) {
            return fault(list,
                         fmt::format("face corner {}: {} index {} is out of range", in_quotes(word), name, *value));
        }
        if (*value > total_.elements[list]) {
            return fault(list, fmt::format("{} index {} is out of range, the file has {}", name, *value,
                                           total_.elements[list]));
        }
        const std::int64_t absolute = *value < 0 ? so_far + 1 + *value : *value;
        check_usable(list, absolute);
        return static_cast<std::uint32_t>(absolute - 1);
    }

    /// `number`: from 1.
    void check_usable(std::size_t list, std::int64_t number) {
        if (std::binary_search(unusable_[list].begin(), unusable_[list].end(), number)) {
            fault(list, fmt::format("{} {} is left out", kObjElementNames[list], number));
        }
    }

    std::uint32_t fault(std::size_t list, const std::string& what) {
        if (faults[list].empty()) {
            faults[list] = what;
        }
        return ObjCorner::kNone;
    }

    const UnusableElements& unusable_;
    const ObjCounts& total_;
};

}  // namespace

void ObjTallies::add(const ObjTallies& later) {
    short_faces.add(later.short_faces);
    colors.add(later.colors);
    weights.add(later.weights);
    unknown.add(later.unknown);
    for (std::size_t list = 0; list < kObjLists; ++list) {
        malformed[list].add(later.malformed[list]);
    }
    unusable_faces.add(later.unusable_faces);
    unusable_corners.add(later.unusable_corners);
}

std::vector<std::string> ObjTallies::warnings(const std::filesystem::path& path) const {
    std::vector<std::string> to;
    short_faces.tell(to, path, "face with fewer than 3 corners left out");
    colors.tell(to, path, "vertex color left out: colors come from materials only");
    weights.tell(to, path, "fourth vertex coordinate left out");
    const Tally statements{.count = unknown.count, .first_line = unknown.first_line, .first = {}};
    statements.tell(to, path, fmt::format("unknown statement {} left out", unknown.first));
    for (std::size_t list = 0; list < kObjLists; ++list) {
        malformed[list].tell(to, path, fmt::format("this {} is left out", kObjElementNames[list]));
    }
    unusable_faces.tell(to, path, "this face is left out");
    unusable_corners.tell(to, path, "this face is shown without its normals or texture points");
    return to;
}

ObjCounts count_elements(std::string_view text) {
    ObjCounts counts;
    for (StatementReader reader(text); reader.next();) {
        counts.lines += reader.lines();
        const std::size_t list = list_of(reader.keyword());
        if (list != kObjLists) {
            ++counts.elements[list];
        } else if (reader.keyword() == "f") {
            ++counts.faces;
        }
    }
    return counts;
}

ObjChunkReader::ObjChunkReader(ObjMesh& mesh, const std::filesystem::path& path, const ObjCounts& before,
                               const ObjCounts& total)
    : mesh_(mesh), path_(path), at_(before), total_(total) {
    faces_.runs.push_back({0, kInherited, kInherited, Smoothing::Inherited});
}

void ObjChunkReader::read(std::string_view text, std::int64_t face_count) {
    const auto faces = static_cast<std::size_t>(face_count);
    faces_.corners.reserve(std::min(3 * faces, text.size() / 2));  // a corner takes two characters at least
    faces_.corner_counts.reserve(faces);
    faces_.lines.reserve(faces);
    for (StatementReader reader(text); reader.next(); at_.lines += reader.lines()) {
        line_ = static_cast<int>(at_.lines + 1);
        if (!read_simple(reader.keyword(), reader.arguments())) {
            refuse_control_characters(reader.text(), path_, line_);
            read_any(reader.keyword(), reader.arguments(), reader.text());
        }
    }
}

/// False if the statement, of which nothing is kept then, is to be read in another way.
bool ObjChunkReader::read_simple(std::string_view keyword, std::string_view arguments) {
    const std::size_t list = list_of(keyword);
    return list != kObjLists ? read_simple_element(list, arguments) : keyword == "f" && read_simple_face(arguments);
}

bool ObjChunkReader::read_simple_element(std::size_t list, std::string_view arguments) {
    glm::vec3 values(0.0f);
    const glm::dvec3 origin = list == kVertices ? mesh_.origin : glm::dvec3(0.0);
    if (at_.elements[list] == kMostElements || read_simple_numbers(arguments, values, origin) < kForms[list].least) {
        return false;
    }
    add_element(list, values);
    return true;
}

bool ObjChunkReader::read_simple_face(std::string_view arguments) {
    const std::size_t first = faces_.corners.size();
    const char* const end = arguments.data() + arguments.size();
    bool is_simple = true;
    for (const char* at = skip_blanks(arguments.data(), end); is_simple && at != end; at = skip_blanks(at, end)) {
        ObjCorner corner;
        is_simple = read_simple_corner(at, end, corner);
        faces_.corners.push_back(corner);
    }
    const std::size_t count = faces_.corners.size() - first;
    if (!is_simple || count < 3 || count > kMostCorners) {
        faces_.corners.resize(first);
        return false;
    }
    add_face(static_cast<std::uint32_t>(count), line_);
    return true;
}

/// `v`, `v/t`, `v//n` or `v/t/n`; moves `at` behind it.
bool ObjChunkReader::read_simple_corner(const char*& at, const char* end, ObjCorner& corner) const {
    const auto is_slash = [&] { return at != end && *at == '/'; };
    const auto read_index = [&](std::size_t list) {
        return read_simple_index(at, end, at_.elements[list], total_.elements[list], corner.*kIndexOf[list]);
    };
    if (!read_index(kVertices)) {
        return false;
    }
    if (is_slash()) {
        ++at;
        if (!is_slash() && !read_index(kUvs)) {
            return false;
        }
        if (is_slash()) {
            ++at;
            if (!read_index(kNormals)) {
                return false;
            }
        }
    }
    return at == end || is_blank(*at);
}

void ObjChunkReader::read_any(std::string_view keyword, std::string_view untrimmed, std::string_view statement) {
    const std::size_t first = std::min(untrimmed.find_first_not_of(" \t"), untrimmed.size());
    const std::string arguments(untrimmed.substr(first, untrimmed.find_last_not_of(" \t") + 1 - first));
    const std::size_t list = list_of(keyword);
    if (list != kObjLists) {
        read_element(list, arguments);
    } else if (keyword == "f") {
        odd_faces_.push_back({faces_.size(), statement, at_.elements});
        add_face(0, line_);
    } else if (keyword == "usemtl") {
        const std::string name = material_name(arguments);
        start_run().material = material_index_.find_or(name, [&] { materials_.push_back({name, line_}); });
    } else if (keyword == "o" || keyword == "g") {
        start_run().group = group_index_.find_or(arguments, [&] { groups_.push_back(arguments); });
    } else if (keyword == "s") {
        start_run().smoothing = smoothing_of(arguments);
    } else if (keyword == "mtllib") {
        libraries_.push_back({arguments, line_});
    } else if (!keyword.empty() &&
               std::find(kWithoutEffect.begin(), kWithoutEffect.end(), keyword) == kWithoutEffect.end()) {
        tallies_.unknown.add(line_, [&] { return in_quotes(keyword); });
    }
}

void ObjChunkReader::read_element(std::size_t list, std::string_view arguments) {
    const std::int64_t number = at_.elements[list] + 1;
    if (number > kMostElements) {
        fail_at(path_, line_, fmt::format("too many: {} number {}", kObjElementNames[list], number));
    }
    const std::vector<std::string_view> words = split_words(arguments);
    glm::vec3 values(0.0f);
    const std::string fault =
        read_numbers(words, kForms[list], values, list == kVertices ? mesh_.origin : glm::dvec3(0.0));
    if (!fault.empty()) {
        unusable_[list].push_back(number);
        tallies_.malformed[list].add(line_, [&] { return fault; });
    }
    if (list == kVertices && words.size() > 3) {
        (words.size() == 4 ? tallies_.weights : tallies_.colors).add(line_);
    }
    add_element(list, fault.empty() ? values : glm::vec3(0.0f));
}

void ObjChunkReader::add_element(std::size_t list, const glm::vec3& values) {
    const auto index = static_cast<std::size_t>(at_.elements[list]++);
    if (list == kVertices) {
        mesh_.positions[index] = values;
    } else if (list == kNormals) {
        mesh_.normals[index] = values;
    } else {
        mesh_.uvs[index] = {values.x, values.y};
    }
}

void ObjChunkReader::add_face(std::uint32_t corner_count, int line) {
    faces_.corner_counts.push_back(corner_count);
    faces_.lines.push_back(line);
}

/// The run of the faces from here on.
ObjFaces::Run& ObjChunkReader::start_run() {
    if (faces_.runs.back().first != faces_.size()) {
        faces_.runs.push_back(faces_.runs.back());
        faces_.runs.back().first = faces_.size();
    }
    return faces_.runs.back();
}

void ObjChunkReader::check_faces(const UnusableElements& unusable) {
    const bool are_all_usable =
        std::all_of(unusable.begin(), unusable.end(), [](const auto& numbers) { return numbers.empty(); });
    if (odd_faces_.empty() && are_all_usable) {
        return;
    }
    const ObjFaces read = std::exchange(faces_, {});
    FaceCheck check(unusable, total_);
    auto odd = odd_faces_.begin();
    const ObjCorner* corners = read.corners.data();
    for (std::size_t run = 0; run < read.runs.size(); ++run) {
        faces_.runs.push_back(read.runs[run]);
        faces_.runs.back().first = faces_.size();
        for (std::size_t face = read.runs[run].first; face < read.end_of(run); ++face) {
            const int line = read.lines[face];
            if (odd == odd_faces_.end() || odd->face != face) {
                check.take(corners, read.corner_counts[face]);
                corners += read.corner_counts[face];
            } else if (!check.read(*odd++)) {
                tallies_.short_faces.add(line);
                continue;
            }
            if (check.faults[kVertices].empty()) {
                check.drop_faulty();
                faces_.corners.insert(faces_.corners.end(), check.corners.begin(), check.corners.end());
                add_face(static_cast<std::uint32_t>(check.corners.size()), line);
            }
            tell_faults(check.faults, line);
        }
    }
}

void ObjChunkReader::tell_faults(const std::array<std::string, kObjLists>& faults, int line) {
    if (!faults[kVertices].empty()) {
        tallies_.unusable_faces.add(line, [&] { return faults[kVertices]; });
    } else if (!faults[kNormals].empty() || !faults[kUvs].empty()) {
        tallies_.unusable_corners.add(line, [&] { return faults[faults[kNormals].empty() ? kUvs : kNormals]; });
    }
}

}  // namespace pl
