#include "core/io/obj_face_reader.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/obj_names.h"

namespace pl {

namespace {

constexpr std::size_t kMostCorners = 65536;  // of a face

constexpr std::array<std::uint32_t ObjCorner::*, kObjLists> kIndexOf = {&ObjCorner::vertex, &ObjCorner::normal,
                                                                        &ObjCorner::uv};

/// Statements that are known and change nothing, with any arguments.
constexpr std::array<std::string_view, 4> kWithoutEffect = {"l", "p", "vp", "mg"};

/// Whether the first of the arguments of an `s` statement names a smoothing group.
Smoothing smoothing_of(std::string_view arguments) {
    const std::string_view argument = arguments.substr(0, arguments.find_first_of(" \t#"));
    return argument.empty() || argument == "0" || argument == "off" ? Smoothing::Off : Smoothing::On;
}

/// Reads an index of up to nine digits, which counts from 1, or back from the last of the `so_far` elements; returns its end, or null if it is
/// not one of the `total` elements. Takes half the time of from_chars().
const char* read_usual_index(const char* at, const char* end, std::size_t so_far, std::size_t total,
                             std::uint32_t& index) {
    const bool counts_back = at != end && *at == '-';
    at += counts_back ? 1 : 0;
    const char* const most = end - at > 9 ? at + 9 : end;
    std::uint32_t value = 0;
    for (; at != most && *at >= '0' && *at <= '9'; ++at) {
        value = 10 * value + static_cast<std::uint32_t>(*at - '0');
    }
    index = counts_back ? static_cast<std::uint32_t>(so_far) - value : value - 1;
    return value != 0 && value <= (counts_back ? so_far : total) ? at : nullptr;
}

}  // namespace

void ObjFaceTallies::add(const ObjFaceTallies& later) {
    short_faces.add(later.short_faces);
    unknown.add(later.unknown);
    unusable_faces.add(later.unusable_faces);
    unusable_corners.add(later.unusable_corners);
}

ObjFaceReader::ObjFaceReader(const ObjElements& all, const ObjCounts& before)
    : all_(all), are_all_usable_(all.are_all_usable()), so_far_(before.elements),
      line_(static_cast<int>(before.lines)) {
    faces_.runs.push_back({0, kInherited, kInherited, Smoothing::Inherited});
}

void ObjFaceReader::read(std::string_view text, std::size_t face_count) {
    faces_.corners.reserve(std::min(3 * face_count, text.size() / 2));  // a corner takes two characters at least
    faces_.corner_counts.reserve(face_count);
    faces_.lines.reserve(face_count);
    for (LineReader reader(text, line_); reader.next();) {
        line_ = reader.line();
        if (reader.keyword() == "f") {
            read_face(reader.arguments());
        } else if (const ObjList list = obj_list_of(reader.keyword()); list != kObjLists) {
            ++so_far_[list];
        } else {
            read_look(reader.keyword(), reader.arguments());
        }
    }
}

void ObjFaceReader::read_face(std::string_view arguments) {
    const std::size_t first = faces_.corners.size();
    const char* const end = arguments.data() + arguments.size();
    while (!arguments.empty() && arguments.front() != '#') {
        ObjCorner corner;
        if (const char* at = read_usual_corner(arguments.data(), end, corner); at != nullptr) {
            while (at != end && is_blank(*at)) ++at;
            arguments.remove_prefix(static_cast<std::size_t>(at - arguments.data()));
        } else {
            corner = read_corner(take_word(arguments));
        }
        if (!are_all_usable_) check_usable(corner);
        faces_.corners.push_back(corner);
    }
    const std::size_t count = faces_.corners.size() - first;
    bool is_kept = count >= 3;
    if (!is_kept) {
        tallies_.short_faces.add(line_);
    } else if (count > kMostCorners) {
        is_kept = false;
        tallies_.unusable_faces.add(line_, [&] {
            return fmt::format("a face with {} corners: at most {} are supported", count, kMostCorners);
        });
    } else if (is_faulty_) {
        is_kept = keep_faulty_face(first);
    }
    if (is_faulty_) {
        faults_.fill({});
        is_faulty_ = false;
    }
    if (is_kept) {
        faces_.corner_counts.push_back(static_cast<std::uint32_t>(count));
        faces_.lines.push_back(line_);
    } else {
        faces_.corners.resize(first);
    }
}

/// A corner as most programs write it: `v`, `v/t`, `v//n` or `v/t/n`, with all elements there. Returns its end, or null.
const char* ObjFaceReader::read_usual_corner(const char* at, const char* end, ObjCorner& corner) const {
    const auto is_slash = [&] { return at != end && *at == '/'; };
    const auto read = [&](ObjList list, std::uint32_t& index) {
        at = read_usual_index(at, end, so_far_[list], all_.counts.elements[list], index);
        return at != nullptr;
    };
    if (!read(kObjVertices, corner.vertex)) {
        return nullptr;
    }
    if (is_slash()) {
        ++at;
        if (!is_slash() && !read(kObjUvs, corner.uv)) {
            return nullptr;
        }
        if (is_slash()) {
            ++at;
            if (!read(kObjNormals, corner.normal)) {
                return nullptr;
            }
        }
    }
    return at == end || is_blank(*at) ? at : nullptr;
}

/// Any corner; programs write slashes without an index behind them, too.
ObjCorner ObjFaceReader::read_corner(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::size_t second = std::min(word.find('/', slash + 1), word.size());
    const auto part = [&](std::size_t from, std::size_t to) {
        return from < to ? word.substr(from, to - from) : std::string_view{};
    };
    ObjCorner corner;
    corner.vertex = read_index(kObjVertices, part(0, slash), word);
    corner.uv = read_index(kObjUvs, part(slash + 1, second), word);
    corner.normal = read_index(kObjNormals, part(second + 1, word.size()), word);
    if (slash == 0) {
        fault(kObjVertices,
              fmt::format("expected a face corner such as 1, 1/2, 1//3 or 1/2/3, got {}", in_quotes(word)));
    }
    return corner;
}

/// kNone for an empty part of a corner, and for one with a fault.
std::uint32_t ObjFaceReader::read_index(ObjList list, std::string_view part, std::string_view word) {
    if (part.empty()) {
        return ObjCorner::kNone;
    }
    const char* const name = kObjElementNames[list];
    const auto so_far = static_cast<std::int64_t>(so_far_[list]);
    const auto total = static_cast<std::int64_t>(all_.counts.elements[list]);
    const std::optional<std::int64_t> value = parse_integer(part);
    if (!value) {
        fault(list,
              fmt::format("face corner {}: {} is not an index of a {}", in_quotes(word), in_quotes(part), name));
    } else if (*value == 0) {
        fault(list, fmt::format("face corner {}: {} index 0, indices start at 1", in_quotes(word), name));
    } else if (*value < -so_far) {
        fault(list, fmt::format("face corner {}: {} index {} is out of range, {} precede the face", in_quotes(word),
                                name, *value, so_far));
    } else if (*value > total) {
        fault(list, fmt::format("{} index {} is out of range, the file has {}", name, *value, total));
    } else {
        return static_cast<std::uint32_t>(*value < 0 ? so_far + *value : *value - 1);
    }
    return ObjCorner::kNone;
}

void ObjFaceReader::check_usable(const ObjCorner& corner) {
    for (std::size_t list = 0; list < kObjLists; ++list) {
        const std::uint32_t index = corner.*kIndexOf[list];
        if (index != ObjCorner::kNone && !all_.is_usable(list, index)) {
            fault(list, fmt::format("{} {} is left out", kObjElementNames[list], std::size_t{index} + 1));
        }
    }
}

void ObjFaceReader::fault(std::size_t list, const std::string& what) {
    is_faulty_ = true;
    if (faults_[list].empty()) {
        faults_[list] = what;
    }
}

/// Tells the faults of a face with corners from `first` on, and drops their indices into lists of which one cannot be used; false if these are
/// vertices.
bool ObjFaceReader::keep_faulty_face(std::size_t first) {
    if (!faults_[kObjVertices].empty()) {
        tallies_.unusable_faces.add(line_, [&] { return faults_[kObjVertices]; });
        return false;
    }
    for (const std::size_t list : {kObjNormals, kObjUvs}) {
        for (std::size_t i = first; i < faces_.corners.size() && !faults_[list].empty(); ++i) {
            faces_.corners[i].*kIndexOf[list] = ObjCorner::kNone;
        }
    }
    tallies_.unusable_corners.add(line_,
                                  [&] { return faults_[faults_[kObjNormals].empty() ? kObjUvs : kObjNormals]; });
    return true;
}

void ObjFaceReader::read_look(std::string_view keyword, std::string_view words) {
    const std::string arguments(words);
    if (keyword == "usemtl") {
        const std::string name = material_name(arguments);
        start_run().material = material_index_.find_or(name, [&] { materials_.push_back({name, line_}); });
    } else if (keyword == "o" || keyword == "g") {
        start_run().group = group_index_.find_or(arguments, [&] { groups_.push_back(arguments); });
    } else if (keyword == "s") {
        start_run().smoothing = smoothing_of(arguments);
    } else if (keyword == "mtllib") {
        libraries_.push_back({arguments, line_});
    } else if (std::find(kWithoutEffect.begin(), kWithoutEffect.end(), keyword) == kWithoutEffect.end()) {
        tallies_.unknown.add(line_, [&] { return in_quotes(keyword); });
    }
}

/// The run of the faces from here on.
ObjFaces::Run& ObjFaceReader::start_run() {
    if (faces_.runs.back().first != faces_.size()) {
        faces_.runs.push_back(faces_.runs.back());
        faces_.runs.back().first = faces_.size();
    }
    return faces_.runs.back();
}

}  // namespace pl
