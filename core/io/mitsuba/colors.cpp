// Colors of Mitsuba files: numbers, codes of sRGB, and spectra.
#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/io/texture_file.h"

namespace pl {
namespace {

/// The color of "#rrggbb", if it is one.
std::optional<glm::vec3> color_of_code(std::string_view code) {
    std::uint32_t digits = 0;
    if (code.size() != 7 || code.front() != '#') return std::nullopt;
    const auto [end, error] = std::from_chars(code.data() + 1, code.data() + code.size(), digits, 16);
    if (error != std::errc() || end != code.data() + code.size()) return std::nullopt;
    const auto channel = [&](int shift) { return decode_srgb(static_cast<float>(digits >> shift & 0xffu) / 255.0f); };
    return glm::vec3(channel(16), channel(8), channel(0));
}

}  // namespace

std::optional<glm::vec3> MitsubaObject::color(const std::string& name) const {
    const MitsubaObject object = property(name);
    if (object.is_color()) return object.own_color();
    if (object)
        object.leave_out(
            fmt::format("{} of {} {} is no color, and is not used", in_quotes(name), element(), in_quotes(type())));
    return std::nullopt;
}

bool MitsubaObject::is_color() const {
    constexpr std::array<std::string_view, 5> kColors = {"rgb", "spectrum", "float", "srgb", "blackbody"};
    return std::ranges::find(kColors, element()) != kColors.end();
}

/// Whether it is a color of what shines by itself.
bool MitsubaObject::shines() const {
    for (pugi::xml_node node = node_.parent(); node; node = node.parent())
        if (MitsubaObject(node, *text_).element() == "emitter") return true;
    return false;
}

glm::vec3 MitsubaObject::spectrum_color(const WavelengthSpectrum& spectrum) const {
    const std::string fault = fault_of(spectrum);
    if (!fault.empty()) fail(fmt::format("'{}': {}", attribute("name"), fault));
    return color_of(spectrum, shines() ? SpectrumRole::Shines : SpectrumRole::Lit);
}

glm::vec3 MitsubaObject::own_color() const {
    const std::string kind = element() == "blackbody" ? element() : type();
    if (!kind.empty()) return color_of_type(kind);
    const std::string file_name = attribute("filename");
    if (!file_name.empty()) return spectrum_color(read_spectrum(file_named(attribute("name"), file_name)));
    return color_of_words(attribute("value"));
}

/// Of a `spectrum` with properties of its own. [Mitsuba 3 and 0.6, plugins]
glm::vec3 MitsubaObject::color_of_type(const std::string& type) const {
    const auto list = [&](const char* name) { return numbers(text(name).value_or("")); };
    if (type == "d65" || type == "srgb")
        return color("color").value_or(glm::vec3(1.0f)) * number("scale").value_or(1.0f);
    if (type == "uniform" || type == "rawconstant") return color_of_words(text("value").value_or("1"));
    if (type == "irregular") return spectrum_color({list("wavelengths"), list("values")});
    if (type == "regular") {
        WavelengthSpectrum spectrum{.wavelengths = {}, .values = list("values")};
        const double first = static_cast<double>(number("wavelength_min").value_or(360.0f));
        const double last = static_cast<double>(number("wavelength_max").value_or(830.0f));
        const auto steps = static_cast<double>(std::max<std::size_t>(spectrum.values.size(), 2) - 1);
        for (std::size_t i = 0; i < spectrum.values.size(); ++i)
            spectrum.wavelengths.push_back(first + (last - first) * static_cast<double>(i) / steps);
        return spectrum_color(spectrum);
    }
    if (type == "blackbody") {
        std::string kelvins = text("temperature").value_or(attribute("temperature"));
        if (kelvins.ends_with('K') || kelvins.ends_with('k')) kelvins.pop_back();
        const std::optional<double> temperature = parse_number(kelvins);
        if (!temperature || !(*temperature > 0.0))
            fail(fmt::format("'temperature': expected kelvins above 0, got {}", in_quotes(kelvins)));
        return color_of(black_body(*temperature), SpectrumRole::Shines) *
               static_cast<float>(number_or("scale", static_cast<double>(number("scale").value_or(1.0f))));
    }
    leave_out(fmt::format("spectra of the type {} are shown as gray", in_quotes(type)));
    return glm::vec3(0.5f);
}

glm::vec3 MitsubaObject::color_of_pairs(const std::string& words) const {
    WavelengthSpectrum spectrum;
    for (const std::string_view pair : mitsuba_words(words)) {
        const std::size_t middle = std::min(pair.find(':'), pair.size() - 1);
        const auto wavelength = parse_number(pair.substr(0, middle));
        const auto value = parse_number(pair.substr(middle + 1));
        if (!wavelength || !value) {
            fail(fmt::format("'{}': expected pairs of a wavelength and a value such as 400:0.5, got {}",
                             attribute("name"), in_quotes(pair)));
        }
        spectrum.wavelengths.push_back(*wavelength);
        spectrum.values.push_back(*value);
    }
    return spectrum_color(spectrum);
}

glm::vec3 MitsubaObject::color_of_words(const std::string& words) const {
    if (words.find(':') != std::string::npos) return color_of_pairs(words);
    if (const auto color = color_of_code(words)) return *color;
    const std::vector<double> values = numbers(words);
    if (values.size() != 1 && values.size() != 3)
        fail(fmt::format("'{}': expected one or three numbers, or #rrggbb, got {}", attribute("name"),
                         in_quotes(words)));
    glm::vec3 color(0.0f);
    for (int i = 0; i < 3; ++i)
        color[i] = std::max(static_cast<float>(values[values.size() == 3 ? static_cast<std::size_t>(i) : 0]), 0.0f);
    if (element() == "srgb") return {decode_srgb(color.x), decode_srgb(color.y), decode_srgb(color.z)};
    // A flat spectrum, which in Mitsuba 0.x is gray.
    if (element() == "spectrum" && type().empty() && values.size() == 1 && shines() && !is_of_version_0())
        return color.x * spectrum_color({{1.0, 1e4}, {1.0, 1.0}});
    return color;
}

}  // namespace pl
