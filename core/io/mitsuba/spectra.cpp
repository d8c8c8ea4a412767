#include "core/io/mitsuba/spectra.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/io/texture_file.h"

namespace pl {
namespace {

/// Color matching functions of the standard observer of 1931, and relative power of the illuminant D65. [CIE 15:2004, tables T.4 and T.1]
struct ObservedColor {
    double x, y, z, d65;
};
constexpr double kFirst = 380.0, kStep = 5.0;
constexpr std::array<ObservedColor, 81> kObserved = {
    {{0.001368, 3.9e-05, 0.00645, 49.9755}, {0.002236, 6.4e-05, 0.01055, 52.3118},
     {0.004243, 0.00012, 0.02005, 54.6482}, {0.00765, 0.000217, 0.03621, 68.7015},
     {0.01431, 0.000396, 0.06785, 82.7549}, {0.02319, 0.00064, 0.1102, 87.1204},
     {0.04351, 0.00121, 0.2074, 91.486},    {0.07763, 0.00218, 0.3713, 92.4589},
     {0.13438, 0.004, 0.6456, 93.4318},     {0.21477, 0.0073, 1.03905, 90.057},
     {0.2839, 0.0116, 1.3856, 86.6823},     {0.3285, 0.01684, 1.62296, 95.7736},
     {0.34828, 0.023, 1.74706, 104.865},    {0.34806, 0.0298, 1.7826, 110.936},
     {0.3362, 0.038, 1.77211, 117.008},     {0.3187, 0.048, 1.7441, 117.41},
     {0.2908, 0.06, 1.6692, 117.812},       {0.2511, 0.0739, 1.5281, 116.336},
     {0.19536, 0.09098, 1.28764, 114.861},  {0.1421, 0.1126, 1.0419, 115.392},
     {0.09564, 0.13902, 0.81295, 115.923},  {0.05795, 0.1693, 0.6162, 112.367},
     {0.03201, 0.20802, 0.46518, 108.811},  {0.0147, 0.2586, 0.3533, 109.082},
     {0.0049, 0.323, 0.272, 109.354},       {0.0024, 0.4073, 0.2123, 108.578},
     {0.0093, 0.503, 0.1582, 107.802},      {0.0291, 0.6082, 0.1117, 106.296},
     {0.06327, 0.71, 0.07825, 104.79},      {0.1096, 0.7932, 0.05725, 106.239},
     {0.1655, 0.862, 0.04216, 107.689},     {0.22575, 0.91485, 0.02984, 106.047},
     {0.2904, 0.954, 0.0203, 104.405},      {0.3597, 0.9803, 0.0134, 104.225},
     {0.43345, 0.99495, 0.00875, 104.046},  {0.51205, 1.0, 0.00575, 102.023},
     {0.5945, 0.995, 0.0039, 100.0},        {0.6784, 0.9786, 0.00275, 98.1671},
     {0.7621, 0.952, 0.0021, 96.3342},      {0.8425, 0.9154, 0.0018, 96.0611},
     {0.9163, 0.87, 0.00165, 95.788},       {0.9786, 0.8163, 0.0014, 92.2368},
     {1.0263, 0.757, 0.0011, 88.6856},      {1.0567, 0.6949, 0.001, 89.3459},
     {1.0622, 0.631, 0.0008, 90.0062},      {1.0456, 0.5668, 0.0006, 89.8026},
     {1.0026, 0.503, 0.00034, 89.5991},     {0.9384, 0.4412, 0.00024, 88.6489},
     {0.85445, 0.381, 0.00019, 87.6987},    {0.7514, 0.321, 0.0001, 85.4936},
     {0.6424, 0.265, 5e-05, 83.2886},       {0.5419, 0.217, 3e-05, 83.4939},
     {0.4479, 0.175, 2e-05, 83.6992},       {0.3608, 0.1382, 1e-05, 81.863},
     {0.2835, 0.107, 0.0, 80.0268},         {0.2187, 0.0816, 0.0, 80.1207},
     {0.1649, 0.061, 0.0, 80.2146},         {0.1212, 0.04458, 0.0, 81.2462},
     {0.0874, 0.032, 0.0, 82.2778},         {0.0636, 0.0232, 0.0, 80.281},
     {0.04677, 0.017, 0.0, 78.2842},        {0.0329, 0.01192, 0.0, 74.0027},
     {0.0227, 0.00821, 0.0, 69.7213},       {0.01584, 0.005723, 0.0, 70.6652},
     {0.0113592, 0.004102, 0.0, 71.6091},   {0.00811092, 0.002929, 0.0, 72.979},
     {0.00579035, 0.002091, 0.0, 74.349},   {0.00410946, 0.001484, 0.0, 67.9765},
     {0.00289933, 0.001047, 0.0, 61.604},   {0.00204919, 0.00074, 0.0, 65.7448},
     {0.00143997, 0.00052, 0.0, 69.8856},   {0.000999949, 0.0003611, 0.0, 72.4863},
     {0.000690079, 0.0002492, 0.0, 75.087}, {0.000476021, 0.0001719, 0.0, 69.3398},
     {0.000332301, 0.00012, 0.0, 63.5927},  {0.000234826, 8.48e-05, 0.0, 55.0054},
     {0.00016615, 6e-05, 0.0, 46.4182},     {0.000117413, 4.24e-05, 0.0, 56.6118},
     {8.30753e-05, 3e-05, 0.0, 66.8054},    {5.87065e-05, 2.12e-05, 0.0, 65.0941},
     {4.15099e-05, 1.499e-05, 0.0, 63.3828}}};
constexpr double kLast = kFirst + kStep * (kObserved.size() - 1);

/// Linear between entries.
ObservedColor observed_at(double wavelength) {
    const double place = (wavelength - kFirst) / kStep;
    const auto i = std::min(static_cast<std::size_t>(place), kObserved.size() - 2);
    const double t = place - static_cast<double>(i);
    const auto between = [&](double ObservedColor::*of) {
        return (1.0 - t) * kObserved[i].*of + t * kObserved[i + 1].*of;
    };
    return {between(&ObservedColor::x), between(&ObservedColor::y), between(&ObservedColor::z),
            between(&ObservedColor::d65)};
}

double value_at(const WavelengthSpectrum& spectrum, double wavelength) {
    const std::vector<double>& all = spectrum.wavelengths;
    if (wavelength < all.front() || wavelength > all.back()) return 0.0;
    const auto next = std::min(std::upper_bound(all.begin(), all.end(), wavelength), all.end() - 1);
    const auto i = static_cast<std::size_t>(next - all.begin());
    const double t = (wavelength - all[i - 1]) / (all[i] - all[i - 1]);
    return (1.0 - t) * spectrum.values[i - 1] + t * spectrum.values[i];
}

glm::dvec3 srgb_of_xyz(const glm::dvec3& xyz) {
    // [IEC 61966-2-1]
    const glm::dmat3 columns{
        {3.240479, -0.969256, 0.055648}, {-1.537150, 1.875991, -0.204043}, {-0.498535, 0.041556, 1.057311}};
    return columns * xyz;
}

}  // namespace

glm::vec3 color_of(const WavelengthSpectrum& spectrum, bool shines) {
    glm::dvec3 sum(0.0);
    double of_flat = 0.0;
    for (double wavelength = kFirst; wavelength <= kLast; wavelength += 1.0) {
        const ObservedColor at = observed_at(wavelength);
        const double light = shines ? 1.0 : at.d65;
        sum += light * value_at(spectrum, wavelength) * glm::dvec3(at.x, at.y, at.z);
        of_flat += light * at.y;
    }
    return glm::max(glm::vec3(srgb_of_xyz(sum / of_flat)), glm::vec3(0.0f));
}

WavelengthSpectrum black_body(double kelvins) {
    constexpr double kFirstConstant = 1.191042972e-16;  // 2 h c^2, W m^2 sr^-1   [SI 2019]
    constexpr double kSecondConstant = 1.438776877e-2;  // h c / k, m K
    WavelengthSpectrum spectrum;
    for (double wavelength = kFirst; wavelength <= kLast; wavelength += kStep) {
        const double meters = 1e-9 * wavelength;
        spectrum.wavelengths.push_back(wavelength);
        spectrum.values.push_back(1e-9 * kFirstConstant / std::pow(meters, 5.0) /
                                  std::expm1(kSecondConstant / (meters * kelvins)));
    }
    return spectrum;
}

std::string fault_of(const WavelengthSpectrum& spectrum) {
    const std::vector<double>& all = spectrum.wavelengths;
    if (all.size() < 2 || all.size() != spectrum.values.size())
        return fmt::format("expected a value at each of two or more wavelengths, got {} and {}",
                           spectrum.values.size(), all.size());
    const auto falls = std::adjacent_find(all.begin(), all.end(), std::greater_equal<>());
    return falls == all.end() ? ""
                              : fmt::format("expected wavelengths that rise, got {} after {}", falls[1], falls[0]);
}

WavelengthSpectrum read_spectrum(const std::filesystem::path& path) {
    WavelengthSpectrum spectrum;
    const std::string text = read_text_file(path);
    refuse_control_characters(text, path);
    for (LineReader line(text); line.next();) {
        const auto wavelength = parse_number(line.keyword());
        const auto value = parse_number(line.arguments());
        if (!wavelength || !value)
            fail_at(path, line.line(),
                    fmt::format("expected a wavelength and a value, got {} and {}", in_quotes(line.keyword()),
                                in_quotes(line.arguments())));
        spectrum.wavelengths.push_back(*wavelength);
        spectrum.values.push_back(*value);
    }
    return spectrum;
}

// Colors of Mitsuba files: numbers, codes of sRGB, and spectra.

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
    return color_of(spectrum, shines());
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
        return color_of(black_body(*temperature), true) *
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
