#include "core/base/printable.h"

#include <algorithm>
#include <charconv>

namespace pl {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Bytes of the character that a lead byte begins; 0 if no character begins so.
std::size_t length_by(unsigned lead) {
    if (lead < 0x80) return 1;
    if (lead < 0xc2) return 0;
    if (lead < 0xe0) return 2;
    if (lead < 0xf0) return 3;
    return lead < 0xf5 ? 4 : 0;
}

/// Whether the second byte belongs to a number that needs so many bytes, is no half of a pair of UTF-16, and exists. [RFC 3629, section 4]
bool may_follow(unsigned lead, unsigned second) {
    switch (lead) {
    case 0xe0: return second >= 0xa0;
    case 0xed: return second < 0xa0;
    case 0xf0: return second >= 0x90;
    case 0xf4: return second < 0x90;
    default: return true;
    }
}

/// Bytes of the character at the beginning; 0 if there is none.
std::size_t character_length(std::string_view text) {
    const unsigned lead = byte_at(text, 0);
    const std::size_t length = length_by(lead);
    if (length > text.size()) return 0;
    const std::string_view tail = text.substr(std::min<std::size_t>(length, 1), length > 1 ? length - 1 : 0);
    const bool continues =
        std::ranges::all_of(tail, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; });
    return continues && (length < 2 || may_follow(lead, byte_at(text, 1))) ? length : 0;
}

bool is_control(std::string_view character) {
    const unsigned lead = byte_at(character, 0);
    if (character.size() == 1) return (lead < 0x20 && lead != '\n' && lead != '\t') || lead == 0x7f;
    return lead == 0xc2 && byte_at(character, 1) < 0xa0;
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        result += length == 0 || is_control(character) ? kReplacement : character;
        text.remove_prefix(character.size());
    }
    return result;
}

std::string csv_text(std::string_view text) {
    const bool is_formula = !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != text.npos;
    const std::string field = std::string(is_formula ? "'" : "").append(text);
    if (field.find_first_of(",\"\r\n") == field.npos) return field;
    std::string quoted = "\"";
    for (const char c : field) quoted.append(c == '"' ? 2 : 1, c);
    return quoted + "\"";
}

std::string markup_text(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\'': result += "&#39;"; break;
        default: result += c;
        }
    return result;
}

std::string latex_text(std::string_view text) {
    constexpr std::string_view kEscaped = "&%$#_{}";
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\textbackslash{}";
        else if (c == '~' || c == '^')
            (escaped += '\\').append(1, c) += "{}";
        else
            escaped.append(kEscaped.find(c) == kEscaped.npos ? 0 : 1, '\\').append(1, c);
    }
    return escaped;
}

namespace {

template <class T>
std::string print(T value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc{} ? std::string(buffer, end) : std::string();
}

}  // namespace

std::string print_real(double value) { return print(value); }

std::string print_float(float value) { return print(value); }

}  // namespace pl
