#include "core/io/obj_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/name_index.h"
#include "core/io/obj_names.h"

namespace pl {

namespace {

constexpr char kEncodedBlank = '\x1f';  // not in files: the reader refuses control characters
constexpr std::int64_t kNone = 0;       // OBJ indices start at 1

constexpr std::array<std::string_view, 4> kWithoutEffect = {"l", "p", "vp", "mg"};

/// A number less another as a text that the library reads as its float.
std::string plain_number(std::string_view word, double origin) {
    return fmt::format("{:.9g}", static_cast<float>(*parse_number(word) - origin));
}

class ObjChecker {
public:
    ObjChecker(std::string_view text, const std::filesystem::path& path, const glm::dvec3& origin)
        : path_(path), origin_(origin), reader_(text, path) {
        result_.text.reserve(text.size() + text.size() / 8);
        group("");
    }

    CheckedObj run() {
        while (reader_.next()) {
            statement();
        }
        warn();
        return std::move(result_);
    }

private:
    void statement() {
        const std::string_view keyword = reader_.keyword();
        if (keyword == "v") {
            vertex();
        } else if (keyword == "f") {
            face();
        } else if (keyword == "vn") {
            element(result_.normals, 3, 3);
        } else if (keyword == "vt") {
            element(result_.texture_points, 1, 2);
        } else if (keyword == "usemtl") {
            const std::string name = material_name(reader_.arguments());
            result_.material_lines.try_emplace(name, reader_.line());
            fmt::format_to(std::back_inserter(result_.text), "usemtl {}\n", encode_name(name));
        } else if (keyword == "o" || keyword == "g") {
            group(std::string(reader_.arguments()));
        } else if (keyword == "s") {
            smoothing_ = smoothing_of(reader_.arguments());
        } else if (keyword == "mtllib") {
            result_.libraries.push_back({std::string(reader_.arguments()), reader_.line()});
        } else if (!is_without_effect(keyword)) {
            if (unknown_.count == 0) {
                first_unknown_ = in_quotes(keyword);
            }
            unknown_.add(reader_.line());
        }
    }

    void group(const std::string& name) {
        group_ = group_index_.find_or(name, [&] { result_.group_names.push_back(name); });
    }

    void vertex() {
        const std::size_t words = element(result_.vertices, 3, 3);
        if (words == 4) {
            weights_.add(reader_.line());
        } else if (words > 4) {
            colors_.add(reader_.line());
        }
    }

    /// Adds an element of `wanted` numbers, of which all behind the `least` first ones may be missing; returns the number of words.
    std::size_t element(CheckedElements& kind, std::size_t least, std::size_t wanted) {
        if (++kind.count > kMostElements) {
            reader_.fail(fmt::format("too many: {} number {}", kind.name, kind.count));
        }
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        const std::string fault = fault_of_numbers(words, least, wanted);
        if (!fault.empty()) {
            kind.unusable.push_back(kind.count);
            kind.malformed.add(reader_.line(), [&] { return fault; });
        }
        const glm::dvec3 from = &kind == &result_.vertices ? origin_ : glm::dvec3(0.0);
        result_.text += reader_.keyword();
        for (std::size_t i = 0; i < wanted; ++i) {
            (result_.text += ' ') +=
                fault.empty() && i < words.size() ? plain_number(words[i], from[static_cast<int>(i)]) : "0";
        }
        result_.text += '\n';
        return words.size();
    }

    std::string fault_of_numbers(const std::vector<std::string_view>& words, std::size_t least,
                                 std::size_t wanted) const {
        if (words.size() < least) {
            return fmt::format("'{}': expected {} numbers, got {}", reader_.keyword(), least, words.size());
        }
        for (std::size_t i = 0; i < std::min(words.size(), wanted); ++i) {
            const std::optional<double> value = parse_number(words[i]);
            if (!value || std::abs(*value) > kLargestCoordinate) {
                return fmt::format("'{}': expected finite numbers up to 1e18, got {}", reader_.keyword(),
                                   in_quotes(words[i]));
            }
        }
        return {};
    }

    void face() {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        if (words.size() < 3) {
            result_.short_faces.add(reader_.line());
            return;
        }
        result_.text += 'f';
        if (words.size() > kMostCorners) {
            const std::int64_t index =
                unusable(result_.vertices,
                         fmt::format("a face with {} corners: at most {} are supported", words.size(), kMostCorners));
            fmt::format_to(std::back_inserter(result_.text), " {0} {0} {0}", index);
        } else {
            for (const std::string_view word : words) {
                corner(word);
            }
        }
        result_.text += '\n';
        result_.face_lines.push_back(reader_.line());
        result_.face_groups.push_back(group_);
        result_.face_smoothing.push_back(smoothing_);
    }

    /// `v`, `v/t`, `v//n` or `v/t/n`; programs write slashes without an index behind them, too.
    void corner(std::string_view word) {
        const std::size_t first = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', first + 1), word.size());
        const auto part = [&](std::size_t from, std::size_t to) {
            return from < to ? word.substr(from, to - from) : std::string_view{};
        };
        std::int64_t v = index(part(0, first), word, result_.vertices);
        const std::int64_t t = index(part(first + 1, second), word, result_.texture_points);
        const std::int64_t n = index(part(second + 1, word.size()), word, result_.normals);
        if (v == kNone) {
            v = unusable(result_.vertices, fmt::format("expected a face corner such as 1, 1/2, 1//3 or 1/2/3, got {}",
                                                       in_quotes(word)));
        }
        fmt::format_to(std::back_inserter(result_.text), " {}", v);
        if (t != kNone) {
            fmt::format_to(std::back_inserter(result_.text), "/{}", t);
        }
        if (n != kNone) {
            fmt::format_to(std::back_inserter(result_.text), "{}{}", t != kNone ? "/" : "//", n);
        }
    }

    /// Absolute index of one part of a corner, kNone for an empty part.
    std::int64_t index(std::string_view part, std::string_view word, CheckedElements& kind) const {
        if (part.empty()) {
            return kNone;
        }
        const std::optional<std::int64_t> value = parse_integer(part);
        if (!value) {
            return unusable(kind, fmt::format("face corner {}: {} is not an index of a {}", in_quotes(word),
                                              in_quotes(part), kind.name));
        }
        if (*value == 0) {
            return unusable(
                kind, fmt::format("face corner {}: {} index 0, indices start at 1", in_quotes(word), kind.name));
        }
        if (*value < -kind.count) {
            return unusable(kind, fmt::format("face corner {}: {} index {} is out of range, {} precede the face",
                                              in_quotes(word), kind.name, *value, kind.count));
        }
        if (*value > kMostElements) {
            return unusable(
                kind, fmt::format("face corner {}: {} index {} is out of range", in_quotes(word), kind.name, *value));
        }
        return *value < 0 ? kind.count + 1 + *value : *value;
    }

    static std::int64_t unusable(CheckedElements& kind, const std::string& fault) {
        if (kind.first_fault.empty()) {
            kind.first_fault = fault;
        }
        return kUnusableIndex;
    }

    void warn() {
        std::vector<std::string>& to = result_.warnings;
        result_.short_faces.tell(to, path_, "face with fewer than 3 corners left out");
        colors_.tell(to, path_, "vertex color left out: colors come from materials only");
        weights_.tell(to, path_, "fourth vertex coordinate left out");
        unknown_.tell(to, path_, fmt::format("unknown statement {} left out", first_unknown_));
        for (const CheckedElements* kind : {&result_.vertices, &result_.normals, &result_.texture_points}) {
            kind->malformed.tell(to, path_, fmt::format("this {} is left out", kind->name));
        }
    }

    const std::filesystem::path& path_;
    const glm::dvec3 origin_;
    LineReader reader_;
    CheckedObj result_;
    NameIndex group_index_;
    std::uint32_t group_ = 0;
    Smoothing smoothing_ = Smoothing::Off;
    Tally colors_;
    Tally weights_;
    Tally unknown_;
    std::string first_unknown_;
};

}  // namespace

std::string CheckedElements::fault_of(std::int64_t index) const {
    if (index == kUnusableIndex) {
        return first_fault;
    }
    if (index > count) {
        return fmt::format("{} index {} is out of range, the file has {}", name, index, count);
    }
    const bool is_usable = unusable.empty() || !std::binary_search(unusable.begin(), unusable.end(), index);
    return is_usable ? std::string() : fmt::format("{} {} is left out", name, index);
}

bool is_without_effect(std::string_view keyword) {
    return std::find(kWithoutEffect.begin(), kWithoutEffect.end(), keyword) != kWithoutEffect.end();
}

CheckedObj check_obj(std::string_view text, const std::filesystem::path& path, const glm::dvec3& origin) {
    return ObjChecker(text, path, origin).run();
}

std::string encode_name(std::string_view name) {
    std::string word(name);
    std::replace(word.begin(), word.end(), ' ', kEncodedBlank);
    std::replace(word.begin(), word.end(), '\t', kEncodedBlank);
    return word.empty() ? std::string(1, kEncodedBlank) : word;
}

std::string decode_name(std::string_view word) {
    std::string name(word);
    std::replace(name.begin(), name.end(), kEncodedBlank, ' ');
    return name == " " ? std::string() : name;
}

}  // namespace pl
