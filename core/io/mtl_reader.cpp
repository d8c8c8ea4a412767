#include "core/io/mtl_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/line_reader.h"
#include "core/io/mtl.h"
#include "core/io/mtl_entry.h"
#include "core/io/obj_names.h"
#include "core/io/tally.h"
#include "core/scene/description.h"
#include "core/scene/surface_info.h"

namespace pl {

namespace {

/// Numbers: their member of MtlEntry and plausible range. Keys are in small letters: programs write them in any.
struct NumberKey {
    std::string_view name;
    std::optional<float> MtlEntry::*number;
    float least, most;
};
constexpr float kAny = std::numeric_limits<float>::max();
constexpr std::array<NumberKey, 9> kNumbers = {{
    {"ns", &MtlEntry::ns, 0.0f, kAny},
    {"ni", &MtlEntry::ni, kLeastIor, kMostIor},
    {"d", &MtlEntry::d, 0.0f, 1.0f},
    {"tr", &MtlEntry::tr, 0.0f, 1.0f},
    {"pr", &MtlEntry::pr, 0.0f, 1.0f},
    {"pm", &MtlEntry::pm, 0.0f, 1.0f},
    {"pc", &MtlEntry::pc, 0.0f, 1.0f},
    {"pl_roughness", &MtlEntry::roughness, 0.0f, 1.0f},
    {"pl_ior", &MtlEntry::own_ior, kLeastIor, kMostIor},
}};

/// A statement and the member of MtlEntry that its value is kept in.
template <class Value>
struct EntryKey {
    std::string_view name;
    Value MtlEntry::*member;
};
using ColorKey = EntryKey<std::optional<glm::vec3>>;
constexpr std::array<ColorKey, 4> kColors = {{
    {"kd", &MtlEntry::kd},
    {"ke", &MtlEntry::ke},
    {"ks", &MtlEntry::ks},
    {"tf", &MtlEntry::tf},
}};

using MapKey = EntryKey<MtlMap>;
constexpr std::array<MapKey, 8> kMaps = {{
    {"map_kd", &MtlEntry::map_kd},
    {"map_ke", &MtlEntry::map_ke},
    {"map_pr", &MtlEntry::map_pr},
    {"map_ns", &MtlEntry::map_ns},
    {"map_d", &MtlEntry::map_d},
    {"norm", &MtlEntry::norm},
    {"bump", &MtlEntry::bump},
    {"map_bump", &MtlEntry::bump},
}};

/// Left out with a warning, because they would change the picture.
constexpr std::array<std::string_view, 9> kUnsupported = {"disp",   "decal",    "refl", "map_ks", "map_pm",
                                                          "map_tr", "map_refl", "ps",   "aniso"};
/// These change nothing here: light of all directions, and numbers of parts that are not there.
constexpr std::array<std::string_view, 6> kHarmless = {"ka", "map_ka", "sharpness", "map_aat", "pcr", "anisor"};

template <class Names>
bool has(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Keys>
const typename Keys::value_type* find_key(const Keys& keys, std::string_view name) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.name == name; });
    return found == keys.end() ? nullptr : &*found;
}

class MtlReader {
public:
    MtlReader(std::string_view text, const std::filesystem::path& path, std::vector<std::string>& warnings)
        : path_(path), reader_(text), warnings_(warnings) {
        refuse_control_characters(text, path);
    }

    std::vector<MtlEntry> run() {
        while (reader_.next()) {
            statement(lower_case(reader_.keyword()));
        }
        for (auto& [key, tally] : odd_) {
            tally.tell(warnings_, path_, "an implausible value is ignored");
        }
        unknown_.tell(warnings_, path_, "left out");
        if (!unsupported_.empty()) {
            warnings_.push_back(
                fmt::format("{}: ignored, because not supported: {}", path_.string(), fmt::join(unsupported_, ", ")));
        }
        settle_transparency();
        return std::move(entries_);
    }

private:
    void statement(const std::string& key) {
        if (key == "newmtl") {
            begin_material();
        } else if (in_material_) {
            value(key);
        } else {
            unknown_.add(reader_.line(), [&] { return fmt::format("'{}' before any 'newmtl'", reader_.keyword()); });
        }
    }

    void begin_material() {
        const std::string name = material_name(reader_.arguments());
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

    MtlEntry& entry() { return skips_ ? skipped_ : entries_.back(); }

    /// Three numbers of at least 0, or one for gray.
    void color(std::optional<glm::vec3>& to, bool is_reflectance) {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        if (words.size() != 1 && words.size() != 3) {
            return odd(fmt::format("3 numbers (or 1 for gray), got {} words", words.size()));
        }
        glm::vec3 rgb;
        for (int i = 0; i < 3; ++i) {
            const std::string_view word = words[words.size() == 3 ? static_cast<std::size_t>(i) : 0];
            const std::optional<double> number = parse_number(word);
            if (!number || *number < 0.0) {
                return odd(fmt::format("finite numbers of at least 0, got {}", in_quotes(word)));
            }
            rgb[i] = static_cast<float>(*number);
        }
        to = is_reflectance ? clamp_reflectance(rgb) : rgb;
    }

    glm::vec3 clamp_reflectance(const glm::vec3& rgb) {
        if (glm::any(glm::greaterThan(rgb, glm::vec3(1.0f)))) {
            warnings_.push_back(fmt::format("{}: reflectance above 1 is clamped to 1", place(path_, reader_.line())));
        }
        return glm::min(rgb, glm::vec3(1.0f));
    }

    void number(std::optional<float>& to, float least, float most) {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        const std::optional<double> value = words.size() == 1 ? parse_number(words[0]) : std::nullopt;
        if (!value || *value < static_cast<double>(least) || *value > static_cast<double>(most)) {
            return odd(fmt::format("a number {}, got {}",
                                   most == kAny ? fmt::format("of at least {}", least)
                                                : fmt::format("within [{}, {}]", least, most),
                                   in_quotes(reader_.arguments())));
        }
        to = static_cast<float>(*value);
    }

    void value(const std::string& key) {
        if (const ColorKey* const rgb = find_key(kColors, key)) {
            color(entry().*rgb->member, key != "ke");
        } else if (const NumberKey* const scalar = find_key(kNumbers, key)) {
            number(entry().*scalar->number, scalar->least, scalar->most);
        } else if (const MapKey* const image = find_key(kMaps, key)) {
            map(entry().*image->member);
        } else if (key == "illum") {
            std::optional<float> illum;
            number(illum, 0.0f, 10.0f);
            entry().illum = illum ? std::optional(static_cast<int>(*illum)) : entry().illum;
        } else if (key.starts_with("pl_")) {
            own_word(key);
        } else if (has(kUnsupported, key)) {
            if (!is_zero()) {
                unsupported_.insert(std::string(reader_.keyword()));
            }
        } else if (!has(kHarmless, key) && !is_zero()) {
            unknown_.add(reader_.line(), [&] { return fmt::format("unknown key {}", in_quotes(reader_.keyword())); });
        }
    }

    /// Keys that this program alone knows.
    void own_word(const std::string& key) {
        const std::string_view word = reader_.arguments();
        if (key == "pl_two_sided") {
            if (word != "0" && word != "1") {
                return odd(fmt::format("0 or 1, got {}", in_quotes(word)));
            }
            entry().two_sided = word == "1";
        } else if (key == "pl_surface") {
            const std::optional<SurfaceKind> kind = choice_named<SurfaceKind>(word);
            if (!kind) {
                return odd(fmt::format("{}, got {}", fmt::join(choice_names<SurfaceKind>(), ", "), in_quotes(word)));
            }
            entry().surface = kind;
        } else {
            unknown_.add(reader_.line(), [&] {
                return fmt::format("unknown key '{}': expected Pl_two_sided, Pl_surface, Pl_roughness or Pl_ior",
                                   reader_.keyword());
            });
        }
    }

    /// Whether the arguments are zeros: of a part that is not there.
    bool is_zero() const {
        const std::vector<std::string_view> words = split_words(reader_.arguments());
        return !words.empty() && std::all_of(words.begin(), words.end(),
                                             [](std::string_view word) { return parse_number(word) == 0.0; });
    }

    void odd(const std::string& expected) {
        odd_[std::string(reader_.keyword())].add(
            reader_.line(), [&] { return fmt::format("'{}': expected {}", reader_.keyword(), expected); });
    }

    void map(MtlMap& to) {
        const ParsedMap parsed = parse_map(reader_.arguments());
        for (const std::string& option : parsed.unsupported) {
            unsupported_.insert(fmt::format("{} of {}", option, reader_.keyword()));
        }
        if (!parsed.map) {
            return odd("the name of an image, got none");
        }
        to = parsed.map;
        to.line = reader_.line();
    }

    /// `Tr` is 1 - d, but MeshLab and others write d under this name. Nobody writes a surface that cannot be seen: in a file where `Tr`
    /// says 1 of one that is no glass, and nowhere 0, it is d.
    void settle_transparency() {
        const auto counts = [](const MtlEntry& entry) { return entry.tr && !entry.d; };
        bool says_opaque = false;
        Tally by_one;
        for (const MtlEntry& entry : entries_) {
            if (counts(entry) && *entry.tr == 1.0f && !may_be_glass(entry)) by_one.add(entry.line);
            says_opaque = says_opaque || (counts(entry) && *entry.tr == 0.0f);
        }
        const bool is_opacity = by_one.count > 0 && !says_opaque;
        for (MtlEntry& entry : entries_) {
            if (counts(entry)) entry.d = is_opacity ? *entry.tr : 1.0f - *entry.tr;
        }
        if (is_opacity) by_one.tell(warnings_, path_, "Tr 1 is opaque in this file, as MeshLab writes it");
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
    Tally unknown_;
    std::set<std::string> unsupported_;
};

}  // namespace

std::vector<MtlEntry> read_mtl(std::string_view text, const std::filesystem::path& path,
                               std::vector<std::string>& warnings) {
    return MtlReader(text, path, warnings).run();
}

}  // namespace pl
