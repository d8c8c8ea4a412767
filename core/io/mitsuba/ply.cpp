#include "core/io/mitsuba/ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"

namespace pl {
namespace {

enum class PlyEncoding { Text, Little, Big };

struct PlyType {
    std::string_view name;
    std::size_t bytes;
    char kind;  ///< i, u or f
};
constexpr std::array<PlyType, 16> kPlyTypes = {{{"char", 1, 'i'},
                                                {"int8", 1, 'i'},
                                                {"uchar", 1, 'u'},
                                                {"uint8", 1, 'u'},
                                                {"short", 2, 'i'},
                                                {"int16", 2, 'i'},
                                                {"ushort", 2, 'u'},
                                                {"uint16", 2, 'u'},
                                                {"int", 4, 'i'},
                                                {"int32", 4, 'i'},
                                                {"uint", 4, 'u'},
                                                {"uint32", 4, 'u'},
                                                {"float", 4, 'f'},
                                                {"float32", 4, 'f'},
                                                {"double", 8, 'f'},
                                                {"float64", 8, 'f'}}};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count = nullptr;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties{};
};

std::optional<int> channel_of(std::string_view name) {
    if (name == "red" || name == "r") return 0;
    if (name == "green" || name == "g") return 1;
    return name == "blue" || name == "b" ? std::optional(2) : std::nullopt;
}

/// The number of a full color.
float largest_color(const PlyType& type) {
    return type.kind == 'f' ? 1.0f : std::exp2(static_cast<float>(8 * type.bytes)) - 1.0f;
}

class PlyReader {
public:
    explicit PlyReader(const std::filesystem::path& path) : path_(path), bytes_(read_file(path)) {}

    PlyMesh run() {
        read_header();
        for (const PlyElement& element : elements_) {
            // Every element takes a byte at least.
            if (element.count > bytes_.size() - at_ && !element.properties.empty()) {
                fail(fmt::format("expected at most {} elements, got {} of '{}'", bytes_.size() - at_, element.count,
                                 element.name));
            }
            for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) read_element(element);
        }
        check();
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::Input, fmt::format("{}: byte {}: {}", path_.string(), at_, what));
    }

    std::string_view line() {
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string::npos) fail("expected a header that ends with 'end_header'");
        std::string_view text = std::string_view(bytes_).substr(at_, end - at_);
        at_ = end + 1;
        return text.ends_with('\r') ? text.substr(0, text.size() - 1) : text;
    }

    const PlyType* type_named(std::string_view name) const {
        const auto known =
            std::find_if(kPlyTypes.begin(), kPlyTypes.end(), [&](const PlyType& t) { return t.name == name; });
        if (known == kPlyTypes.end()) fail(fmt::format("expected the type of a property, got {}", in_quotes(name)));
        return &*known;
    }

    void read_header() {
        if (line() != "ply") {
            at_ = 0;
            fail("expected a PLY file that begins with 'ply'");
        }
        for (std::string_view text = line(); text != "end_header"; text = line()) {
            const std::vector<std::string_view> words = split_words(text);
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            header_line(words);
        }
    }

    void header_line(const std::vector<std::string_view>& words) {
        if (words[0] == "format" && words.size() >= 2) {
            encoding_ =
                words[1] == "ascii"                  ? PlyEncoding::Text
                : words[1] == "binary_little_endian" ? PlyEncoding::Little
                : words[1] == "binary_big_endian"
                    ? PlyEncoding::Big
                    : (fail(fmt::format("expected a format, got {}", in_quotes(words[1]))), PlyEncoding::Text);
        } else if (words[0] == "element" && words.size() == 3) {
            const std::optional<std::int64_t> count = parse_integer(words[2]);
            if (!count || *count < 0) fail(fmt::format("expected a number of elements, got {}", in_quotes(words[2])));
            elements_.push_back({std::string(words[1]), static_cast<std::uint64_t>(*count)});
        } else if (words[0] == "property" && !elements_.empty() && words.size() == 3) {
            elements_.back().properties.push_back({std::string(words[2]), type_named(words[1])});
        } else if (words[0] == "property" && !elements_.empty() && words.size() == 5 && words[1] == "list") {
            elements_.back().properties.push_back(
                {std::string(words[4]), type_named(words[3]), type_named(words[2])});
        } else {
            fail(fmt::format("expected a line of a PLY header, got {}", in_quotes(words[0])));
        }
    }

    double number(const PlyType& type) { return encoding_ == PlyEncoding::Text ? word() : stored(type); }

    double word() {
        const std::size_t first = std::min(bytes_.find_first_not_of(" \t\r\n", at_), bytes_.size());
        const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", first), bytes_.size());
        const std::string_view text = std::string_view(bytes_).substr(first, end - first);
        const std::optional<double> value = parse_number(text);
        if (!value) fail(fmt::format("expected a finite number, got {}", in_quotes(text)));
        at_ = end;
        return *value;
    }

    double stored(const PlyType& type) {
        if (bytes_.size() - at_ < type.bytes)
            fail(fmt::format("expected {} bytes of a number, got the end of the file", type.bytes));
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t from = encoding_ == PlyEncoding::Little ? type.bytes - 1 - i : i;
            bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + from]);
        }
        at_ += type.bytes;
        if (type.kind == 'f') {
            return type.bytes == 8 ? std::bit_cast<double>(bits)
                                   : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        }
        const int unused = static_cast<int>(64 - 8 * type.bytes);
        return type.kind == 'u' ? static_cast<double>(bits)
                                : static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }

    void read_element(const PlyElement& element) {
        glm::dvec3 position(0.0);
        glm::vec3 normal(0.0f), color(0.0f);
        glm::vec2 uv(0.0f);
        bool has_normal = false, has_uv = false, has_color = false;
        for (const PlyProperty& property : element.properties) {
            if (property.count != nullptr) {
                read_list(element, property);
                continue;
            }
            const double full = number(*property.type);
            const auto value = static_cast<float>(full);
            const std::string& name = property.name;
            if (name == "x" || name == "y" || name == "z") {
                position[name[0] - 'x'] = full;
            } else if (name == "nx" || name == "ny" || name == "nz") {
                normal[name[1] - 'x'] = value;
                has_normal = true;
            } else if (name == "u" || name == "s" || name == "v" || name == "t") {
                uv[name == "u" || name == "s" ? 0 : 1] = value;
                has_uv = true;
            } else if (const std::optional<int> channel = channel_of(name)) {
                color[*channel] = value / largest_color(*property.type);
                has_color = true;
            }
        }
        if (element.name != "vertex") return;
        mesh_.positions.push_back(position);
        if (has_normal) mesh_.normals.push_back(normal);
        if (has_uv) mesh_.uvs.push_back(uv);
        if (has_color) mesh_.colors.push_back(color);
    }

    void read_list(const PlyElement& element, const PlyProperty& property) {
        const double count = number(*property.count);
        if (!(count >= 0.0 && count <= 65536.0))
            fail(fmt::format("expected a list of at most 65536 numbers, got {}", count));
        const bool is_face = element.name == "face" && property.name.starts_with("vert");
        std::vector<std::uint32_t> corners;
        for (int i = 0; i < static_cast<int>(count); ++i) {
            const double value = number(*property.type);
            if (is_face && !(value >= 0.0 && value < 4294967295.0))
                fail(fmt::format("expected the index of a vertex, got {}", value));
            corners.push_back(is_face ? static_cast<std::uint32_t>(value) : 0u);
        }
        for (std::size_t i = 1; is_face && i + 1 < corners.size(); ++i)
            mesh_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
    }

    void check() const {
        for (const std::array<std::uint32_t, 3>& triangle : mesh_.triangles) {
            for (const std::uint32_t vertex : triangle) {
                if (vertex >= mesh_.positions.size()) {
                    fail(fmt::format("expected indices below {}, the number of vertices, got {}",
                                     mesh_.positions.size(), vertex));
                }
            }
        }
        for (const glm::vec2& uv : mesh_.uvs)
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) fail("expected finite texture coordinates");
    }

    const std::filesystem::path& path_;
    std::string bytes_;
    std::size_t at_ = 0;
    PlyEncoding encoding_ = PlyEncoding::Text;
    std::vector<PlyElement> elements_;
    PlyMesh mesh_;
};

}  // namespace

PlyMesh read_ply(const std::filesystem::path& path) { return PlyReader(path).run(); }

}  // namespace pl
