#include "core/io/mtl.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tiny_obj_loader.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/obj_check.h"

namespace pl {

namespace {

constexpr const char* kTwoSidedKey = "Pl_two_sided";

/// An MTL text that is safe to hand on, and what the library would not tell.
struct CheckedMtl {
    std::string text;
    std::set<std::string> with_color;  ///< encoded names that have Kd or Ke
};

class MtlChecker {
public:
    MtlChecker(std::string_view text, const std::filesystem::path& path, std::vector<std::string>& warnings)
        : path_(path), reader_(text, path), warnings_(warnings) {}

    CheckedMtl run() {
        while (reader_.next()) {
            statement();
        }
        if (!unsupported_.empty()) {
            warnings_.push_back(
                fmt::format("{}: left out, because this version has no textures and no transparency: {}",
                            path_.string(), fmt::join(unsupported_, ", ")));
        }
        return std::move(result_);
    }

private:
    void statement() {
        const std::string keyword(reader_.keyword());
        if (keyword == "newmtl") {
            begin_material();
        } else if (keyword == "Kd" || keyword == "Ke") {
            need_material();
            color(keyword);
        } else if (keyword == kTwoSidedKey) {
            need_material();
            two_sided();
        } else if (keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "disp") {
            unsupported_.insert(keyword);
        } else if (keyword == "d" || keyword == "Tr") {
            const std::optional<double> value = parse_number(reader_.arguments());
            if (value && *value != (keyword == "d" ? 1.0 : 0.0)) {
                unsupported_.insert(keyword);
            }
        }
    }

    void begin_material() {
        const std::string name(reader_.arguments());
        if (name.empty()) {
            reader_.fail("'newmtl': expected a name");
        }
        name_ = encode_name(name);
        if (!names_.insert(name_).second) {
            warnings_.push_back(fmt::format("{}: material {} is there already: the first one counts",
                                            place(path_, reader_.line()), in_quotes(name)));
            name_ = kSkipped;
            return;
        }
        fmt::format_to(std::back_inserter(result_.text), "newmtl {}\n", name_);
    }

    void need_material() const {
        if (name_.empty()) {
            reader_.fail(fmt::format("'{}' before any 'newmtl'", reader_.keyword()));
        }
    }

    void color(const std::string& keyword) {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        if (words.size() != 1 && words.size() != 3) {
            reader_.fail(
                fmt::format("'{}': expected 3 numbers (or 1 for gray), got {} words", keyword, words.size()));
        }
        std::array<double, 3> rgb{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string_view word = words[words.size() == 3 ? i : 0];
            const std::optional<double> value = parse_number(word);
            if (!value || *value < 0.0) {
                reader_.fail(
                    fmt::format("'{}': expected finite numbers of at least 0, got {}", keyword, in_quotes(word)));
            }
            rgb[i] = *value;
        }
        if (keyword == "Kd" && *std::max_element(rgb.begin(), rgb.end()) > 1.0) {
            warnings_.push_back(fmt::format("{}: reflectance above 1 is clamped to 1", place(path_, reader_.line())));
            std::transform(rgb.begin(), rgb.end(), rgb.begin(), [](double c) { return std::min(c, 1.0); });
        }
        if (name_ == kSkipped) {
            return;
        }
        result_.with_color.insert(name_);
        fmt::format_to(std::back_inserter(result_.text), "{} {} {} {}\n", keyword, rgb[0], rgb[1], rgb[2]);
    }

    void two_sided() {
        const std::string_view value = reader_.arguments();
        if (value != "0" && value != "1") {
            reader_.fail(fmt::format("'{}': expected 0 or 1, got {}", kTwoSidedKey, in_quotes(value)));
        }
        if (name_ != kSkipped) {
            fmt::format_to(std::back_inserter(result_.text), "{} {}\n", kTwoSidedKey, value);
        }
    }

    inline static const std::string kSkipped{"\n"};  // no name: the reader never returns an end of line

    const std::filesystem::path& path_;
    LineReader reader_;
    std::vector<std::string>& warnings_;
    CheckedMtl result_;
    std::string name_;
    std::set<std::string> names_;
    std::set<std::string> unsupported_;
};

glm::vec3 to_vec3(const tinyobj::real_t* rgb) { return {rgb[0], rgb[1], rgb[2]}; }

}  // namespace

std::vector<MaterialDescription> load_mtl(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    const CheckedMtl checked = MtlChecker(read_text_file(path), path, warnings).run();
    std::map<std::string, int> positions;
    std::vector<tinyobj::material_t> parsed;
    std::istringstream stream(checked.text);
    tinyobj::LoadMtl(&positions, &parsed, &stream, nullptr, nullptr);

    std::vector<MaterialDescription> materials;
    for (const tinyobj::material_t& entry : parsed) {
        if (entry.name.empty()) {
            continue;  // the library adds one for a file without materials
        }
        MaterialDescription material{
            .name = decode_name(entry.name), .albedo = to_vec3(entry.diffuse), .emission = to_vec3(entry.emission)};
        const auto two_sided = entry.unknown_parameter.find(kTwoSidedKey);
        material.two_sided_emission = two_sided != entry.unknown_parameter.end() && two_sided->second == "1";
        if (!checked.with_color.contains(entry.name)) {
            material.albedo = kDefaultAlbedo;
            warnings.push_back(fmt::format("{}: material {} has neither Kd nor Ke and is shown in the default color",
                                           path.string(), in_quotes(material.name)));
        }
        materials.push_back(std::move(material));
    }
    return materials;
}

}  // namespace pl
