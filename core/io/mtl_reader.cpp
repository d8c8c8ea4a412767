#include "core/io/mtl_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/line_reader.h"
#include "core/io/mtl_map.h"
#include "core/io/obj_check.h"
#include "core/io/surface_names.h"
#include "core/io/tally.h"
#include "core/scene/description.h"

namespace pl {

namespace {

/// Keys that other programs write: their member of MtlEntry and plausible range. Others are ignored with a warning.
struct NumberKey {
    std::string_view name;
    std::optional<float> MtlEntry::*number;
    float least, most;
};
constexpr float kAny = std::numeric_limits<float>::max();
constexpr std::array<NumberKey, 6> kNumbers = {{
    {"Ns", &MtlEntry::ns, 0.0f, kAny},
    {"Ni", &MtlEntry::ni, kLeastIor, kMostIor},
    {"d", &MtlEntry::d, 0.0f, 1.0f},
    {"Pr", &MtlEntry::pr, 0.0f, 1.0f},
    {"Pm", &MtlEntry::pm, 0.0f, 1.0f},
    {"Pc", &MtlEntry::pc, 0.0f, 1.0f},
}};

/// Pl_ keys: values out of range are errors.
constexpr std::array<NumberKey, 2> kOwnNumbers = {{
    {"Pl_roughness", &MtlEntry::roughness, 0.0f, 1.0f},
    {"Pl_ior", &MtlEntry::own_ior, kLeastIor, kMostIor},
}};

struct MapKey {
    std::string_view name;
    MtlMap MtlEntry::*map;
};
constexpr std::array<MapKey, 9> kMaps = {{
    {"map_Kd", &MtlEntry::map_kd},
    {"map_Ke", &MtlEntry::map_ke},
    {"map_Pr", &MtlEntry::map_pr},
    {"map_Ns", &MtlEntry::map_ns},
    {"map_d", &MtlEntry::map_d},
    {"norm", &MtlEntry::norm},
    {"bump", &MtlEntry::bump},
    {"map_bump", &MtlEntry::bump},
    {"map_Bump", &MtlEntry::bump},
}};

/// Ignored with a warning, because they would change the picture.
constexpr std::array<std::string_view, 7> kUnsupported = {"disp",   "decal",  "refl",    "map_Ks",
                                                          "map_Pm", "map_Tr", "map_refl"};

template <class Keys>
const typename Keys::value_type* find_key(const Keys& keys, std::string_view name) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.name == name; });
    return found == keys.end() ? nullptr : &*found;
}

class MtlReader {
public:
    MtlReader(std::string_view text, const std::filesystem::path& path, std::vector<std::string>& warnings)
        : path_(path), reader_(text, path), warnings_(warnings) {}

    std::vector<MtlEntry> run() {
        while (reader_.next()) {
            statement(reader_.keyword());
        }
        for (auto& [key, tally] : odd_) {
            tally.tell(warnings_, path_, fmt::format("'{}': an implausible value is ignored", key));
        }
        if (!unsupported_.empty()) {
            warnings_.push_back(
                fmt::format("{}: ignored, because not supported: {}", path_.string(), fmt::join(unsupported_, ", ")));
        }
        return std::move(entries_);
    }

private:
    void statement(std::string_view keyword) {
        if (keyword == "newmtl") {
            begin_material();
        } else if (keyword == "Kd" || keyword == "Ke") {
            need_material();
            color(keyword == "Kd" ? entry().kd : entry().ke, keyword == "Kd");
        } else if (keyword.starts_with("Pl_")) {
            need_material();
            own_value(keyword);
        } else if (in_material_) {
            foreign_value(keyword);
        }
    }

    void begin_material() {
        const std::string name = decode_name(encode_name(reader_.arguments()));  // as `usemtl` encodes it
        in_material_ = true;
        skips_ = !names_.insert(name).second;
        if (skips_) {
            warnings_.push_back(fmt::format("{}: material {} is there already: the first one counts",
                                            place(path_, reader_.line()), in_quotes(name)));
            skipped_ = {};
            return;
        }
        entries_.emplace_back();
        entries_.back().name = name;
        entries_.back().line = reader_.line();
    }

    void need_material() const {
        if (!in_material_) {
            reader_.fail(fmt::format("'{}' before any 'newmtl'", reader_.keyword()));
        }
    }

    MtlEntry& entry() { return skips_ ? skipped_ : entries_.back(); }

    /// Three numbers of at least 0, or one for gray; nothing otherwise, with the word in `wrong`.
    std::optional<glm::vec3> parse_color(std::string_view& wrong) const {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        if (words.size() != 1 && words.size() != 3) {
            return std::nullopt;
        }
        glm::vec3 rgb;
        for (int i = 0; i < 3; ++i) {
            const std::string_view word = words[words.size() == 3 ? static_cast<std::size_t>(i) : 0];
            const std::optional<double> value = parse_number(word);
            if (!value || *value < 0.0) {
                wrong = word;
                return std::nullopt;
            }
            rgb[i] = static_cast<float>(*value);
        }
        return rgb;
    }

    void color(std::optional<glm::vec3>& to, bool is_reflectance) {
        std::string_view wrong;
        const std::optional<glm::vec3> rgb = parse_color(wrong);
        if (!rgb && wrong.empty()) {
            reader_.fail(fmt::format("'{}': expected 3 numbers (or 1 for gray), got {} words", reader_.keyword(),
                                     split_words(reader_.arguments()).size()));
        }
        if (!rgb) {
            reader_.fail(fmt::format("'{}': expected finite numbers of at least 0, got {}", reader_.keyword(),
                                     in_quotes(wrong)));
        }
        to = is_reflectance ? clamp_reflectance(*rgb) : *rgb;
    }

    glm::vec3 clamp_reflectance(const glm::vec3& rgb) {
        if (glm::any(glm::greaterThan(rgb, glm::vec3(1.0f)))) {
            warnings_.push_back(fmt::format("{}: reflectance above 1 is clamped to 1", place(path_, reader_.line())));
        }
        return glm::min(rgb, glm::vec3(1.0f));
    }

    std::optional<float> parse_within(float least, float most) const {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        const std::optional<double> value = words.size() == 1 ? parse_number(words[0]) : std::nullopt;
        const bool fits = value && *value >= static_cast<double>(least) && *value <= static_cast<double>(most);
        return fits ? std::optional(static_cast<float>(*value)) : std::nullopt;
    }

    void own_value(std::string_view keyword) {
        const std::string_view value = reader_.arguments();
        if (keyword == "Pl_two_sided") {
            if (value != "0" && value != "1") {
                reader_.fail(fmt::format("'{}': expected 0 or 1, got {}", keyword, in_quotes(value)));
            }
            entry().two_sided = value == "1";
        } else if (keyword == "Pl_surface") {
            entry().surface = surface_kind(value);
            if (!entry().surface) {
                reader_.fail(fmt::format("'{}': expected {}, got {}", keyword, fmt::join(kSurfaceNames, ", "),
                                         in_quotes(value)));
            }
        } else if (const NumberKey* const key = find_key(kOwnNumbers, keyword)) {
            entry().*key->number = parse_within(key->least, key->most);
            if (!(entry().*key->number)) {
                reader_.fail(fmt::format("'{}': expected a number within [{}, {}], got {}", keyword, key->least,
                                         key->most, in_quotes(value)));
            }
        } else {
            reader_.fail(
                fmt::format("unknown key '{}': expected Pl_two_sided, Pl_surface, Pl_roughness or Pl_ior", keyword));
        }
    }

    /// A key that other programs write for other renderers: invalid values are ignored with a warning.
    void foreign_value(std::string_view keyword) {
        if (const NumberKey* const key = find_key(kNumbers, keyword)) {
            keep(entry().*key->number, parse_within(key->least, key->most));
        } else if (keyword == "Tr") {
            const std::optional<float> tr = parse_within(0.0f, 1.0f);
            if (!entry().d || !tr) {  // d = 1 - Tr; programs agree on the meaning of d only
                keep(entry().d, tr ? std::optional(1.0f - *tr) : tr);
            }
        } else if (keyword == "illum") {
            const std::optional<float> illum = parse_within(0.0f, 10.0f);
            keep(entry().illum, illum ? std::optional(static_cast<int>(*illum)) : std::nullopt);
        } else if (keyword == "Ks" || keyword == "Tf") {
            std::string_view wrong;
            const std::optional<glm::vec3> rgb = parse_color(wrong);
            keep(keyword == "Ks" ? entry().ks : entry().tf, rgb ? std::optional(clamp_reflectance(*rgb)) : rgb);
        } else if (const MapKey* const image = find_key(kMaps, keyword)) {
            map(entry().*image->map);
        } else if (std::find(kUnsupported.begin(), kUnsupported.end(), keyword) != kUnsupported.end()) {
            unsupported_.insert(std::string(keyword));
        }
    }

    template <class Value>
    void keep(std::optional<Value>& to, const std::optional<Value>& value) {
        if (value) {
            to = value;
        } else {
            odd_[std::string(reader_.keyword())].add(reader_.line());
        }
    }

    void map(MtlMap& to) {
        const ParsedMap parsed = parse_map(reader_.arguments());
        for (const std::string& option : parsed.unsupported) {
            unsupported_.insert(fmt::format("{} of {}", option, reader_.keyword()));
        }
        if (parsed.map) {
            to = parsed.map;
        } else {
            odd_[std::string(reader_.keyword())].add(reader_.line());
        }
    }

    const std::filesystem::path& path_;
    LineReader reader_;
    std::vector<std::string>& warnings_;
    std::vector<MtlEntry> entries_;
    std::set<std::string> names_;
    bool in_material_ = false;
    bool skips_ = false;
    MtlEntry skipped_;  ///< receives the statements of duplicate materials
    std::map<std::string, Tally> odd_;
    std::set<std::string> unsupported_;
};

}  // namespace

std::vector<MtlEntry> read_mtl(std::string_view text, const std::filesystem::path& path,
                               std::vector<std::string>& warnings) {
    return MtlReader(text, path, warnings).run();
}

}  // namespace pl
