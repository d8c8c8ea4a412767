#include "core/io/obj_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/line_reader.h"
#include "core/io/name_index.h"
#include "core/io/tally.h"

namespace pl {

namespace {

constexpr char kEncodedBlank = '\x1f';  // not in files: the reader refuses control characters
constexpr std::int64_t kNone = 0;       // OBJ indices start at 1

constexpr std::array<std::string_view, 4> kWithoutEffect = {"l", "p", "vp", "mg"};

/// Number of elements of a kind so far, and the forward references to later ones.
struct Elements {
    struct Forward {
        std::int64_t index;
        int line;
    };
    const char* name;
    std::int64_t count = 0;
    std::vector<Forward> forward{};
};

/// A number as a text that the library reads as its float.
std::string plain_number(std::string_view word) {
    return fmt::format("{:.9g}", static_cast<float>(*parse_number(word)));
}

class ObjChecker {
public:
    ObjChecker(std::string_view text, const std::filesystem::path& path) : path_(path), reader_(text, path) {
        result_.text.reserve(text.size() + text.size() / 8);
        group("");
    }

    CheckedObj run() {
        while (reader_.next()) {
            statement();
        }
        if (result_.face_lines.empty()) {
            throw Error(ErrorKind::Input, fmt::format("{}: no faces: expected at least one 'f' statement with three "
                                                      "corners, got {} vertices and {} faces of fewer corners",
                                                      path_.string(), vertices_.count, short_faces_.count));
        }
        for (const Elements* kind : {&vertices_, &normals_, &texture_points_}) {
            check_forward(*kind);
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
            copy_numbers("vn", numbers(), 3);
            count_one(normals_);
        } else if (keyword == "vt") {
            texture_point();
        } else if (keyword == "usemtl") {
            const std::string word = encode_name(reader_.arguments());
            result_.material_lines.try_emplace(decode_name(word), reader_.line());
            fmt::format_to(std::back_inserter(result_.text), "usemtl {}\n", word);
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
        const std::vector<std::string_view> words = numbers();
        if (words.size() == 4) {
            weights_.add(reader_.line());
        } else if (words.size() > 4) {
            colors_.add(reader_.line());
        }
        copy_numbers("v", words, 3);
        count_one(vertices_);
    }

    /// `vt`: one to three numbers, of which two count.
    void texture_point() {
        std::vector<std::string_view> words = numbers();
        if (words.size() == 1) {
            words.push_back("0");
        }
        copy_numbers("vt", words, 2);
        count_one(texture_points_);
    }

    /// The arguments, all of which must be numbers.
    std::vector<std::string_view> numbers() const {
        std::vector<std::string_view> words = split_words(reader_.arguments());
        for (const std::string_view word : words) {
            const std::optional<double> value = parse_number(word);
            if (!value || std::abs(*value) > kLargestCoordinate) {
                reader_.fail(fmt::format("'{}': expected finite numbers up to 1e18, got {}", reader_.keyword(),
                                         in_quotes(word)));
            }
        }
        return words;
    }

    void copy_numbers(const char* keyword, const std::vector<std::string_view>& words, std::size_t wanted) {
        if (words.size() < wanted) {
            reader_.fail(fmt::format("'{}': expected {} numbers, got {}", keyword, wanted, words.size()));
        }
        result_.text += keyword;
        for (std::size_t i = 0; i < wanted; ++i) {
            (result_.text += ' ') += plain_number(words[i]);
        }
        result_.text += '\n';
    }

    void count_one(Elements& kind) const {
        if (++kind.count > kMostElements) {
            reader_.fail(fmt::format("too many: {} number {}", kind.name, kind.count));
        }
    }

    void face() {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        if (words.size() > kMostCorners) {
            reader_.fail(fmt::format("a face with {} corners: at most {} are supported", words.size(), kMostCorners));
        }
        const std::size_t start = result_.text.size();
        result_.text += 'f';
        for (const std::string_view word : words) {
            corner(word);
        }
        result_.text += '\n';
        if (words.size() < 3) {
            result_.text.resize(start);
            short_faces_.add(reader_.line());
            return;
        }
        result_.face_lines.push_back(reader_.line());
        result_.face_groups.push_back(group_);
        result_.face_smoothing.push_back(smoothing_);
    }

    /// `v`, `v/t`, `v//n` or `v/t/n`.
    void corner(std::string_view word) {
        const std::size_t first = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', first + 1), word.size());
        const auto part = [&](std::size_t from, std::size_t to) {
            return from < to ? word.substr(from, to - from) : std::string_view{};
        };
        const std::int64_t v = index(part(0, first), word, vertices_);
        const std::int64_t t = index(part(first + 1, second), word, texture_points_);
        const std::int64_t n = index(part(second + 1, word.size()), word, normals_);
        if (v == kNone || word.ends_with('/') || (t == kNone && n == kNone && first != word.size())) {
            reader_.fail(
                fmt::format("expected a face corner such as 1, 1/2, 1//3 or 1/2/3, got {}", in_quotes(word)));
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
    std::int64_t index(std::string_view part, std::string_view word, Elements& kind) const {
        if (part.empty()) {
            return kNone;
        }
        const std::optional<std::int64_t> value = parse_integer(part);
        if (!value) {
            reader_.fail(fmt::format("face corner {}: {} is not an index of a {}", in_quotes(word), in_quotes(part),
                                     kind.name));
        }
        if (*value == 0) {
            reader_.fail(fmt::format("face corner {}: {} index 0, indices start at 1", in_quotes(word), kind.name));
        }
        if (*value < -kind.count) {
            reader_.fail(fmt::format("face corner {}: {} index {} is out of range, {} precede the face",
                                     in_quotes(word), kind.name, *value, kind.count));
        }
        if (*value > kind.count) {
            kind.forward.push_back({*value, reader_.line()});
        }
        // Out-of-range indices are refused at the end of the file; until then they are clamped to a printable number.
        return *value < 0 ? kind.count + 1 + *value : std::min(*value, kMostElements);
    }

    void check_forward(const Elements& kind) const {
        for (const Elements::Forward& forward : kind.forward) {
            if (forward.index > kind.count) {
                fail_at(path_, forward.line,
                        fmt::format("{} index {} is out of range, the file has {}", kind.name, forward.index,
                                    kind.count));
            }
        }
    }

    void warn() {
        std::vector<std::string>& to = result_.warnings;
        short_faces_.tell(to, path_, "face with fewer than 3 corners left out");
        colors_.tell(to, path_, "vertex color left out: colors come from materials only");
        weights_.tell(to, path_, "fourth vertex coordinate left out");
        unknown_.tell(to, path_, fmt::format("unknown statement {} left out", first_unknown_));
    }

    const std::filesystem::path& path_;
    LineReader reader_;
    CheckedObj result_;
    NameIndex group_index_;
    std::uint32_t group_ = 0;
    Smoothing smoothing_ = Smoothing::Off;
    Elements vertices_{.name = "vertex"};
    Elements normals_{.name = "normal"};
    Elements texture_points_{.name = "texture point"};
    Tally short_faces_;
    Tally colors_;
    Tally weights_;
    Tally unknown_;
    std::string first_unknown_;
};

}  // namespace

bool is_without_effect(std::string_view keyword) {
    return std::find(kWithoutEffect.begin(), kWithoutEffect.end(), keyword) != kWithoutEffect.end();
}

CheckedObj check_obj(std::string_view text, const std::filesystem::path& path) {
    return ObjChecker(text, path).run();
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
