#include "core/io/line_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {

namespace {

const char* skip_blanks(const char* at, const char* end) {
    while (at != end && is_blank(*at)) {
        ++at;
    }
    return at;
}

const char* skip_word(const char* at, const char* end) {
    while (at != end && !is_blank(*at)) {
        ++at;
    }
    return at;
}

const char* find(char c, const char* begin, const char* end) {
    const void* const found = begin != end ? std::memchr(begin, c, static_cast<std::size_t>(end - begin)) : nullptr;
    return found != nullptr ? static_cast<const char*>(found) : end;
}

std::string_view between(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
}

bool is_control(char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\t') || code == 0x7f;
}

/// from_chars() does not distinguish overflow from underflow.
bool is_underflow(std::string_view word) {
    const std::size_t exponent = word.find_first_of("eE");
    if (exponent != std::string_view::npos) {
        return word.substr(exponent + 1).starts_with('-');
    }
    return word.substr(0, word.find('.')).find_first_of("123456789") == std::string_view::npos;
}

}  // namespace

std::string place(const std::filesystem::path& path, int line) { return fmt::format("{}:{}", path.string(), line); }

void fail_at(const std::filesystem::path& path, int line, const std::string& what) {
    throw Error(ErrorKind::Input, place(path, line) + ": " + what);
}

void refuse_control_characters(std::string_view text, const std::filesystem::path& path) {
    const auto is_refused = [](char c) { return is_control(c) && c != '\n' && c != '\r'; };
    // Bytes of blocks of a constant size are compared in vectors.
    constexpr std::size_t kBlock = 256;
    std::size_t at = 0;
    for (unsigned char refused = 0; text.size() - at >= kBlock; at += kBlock) {
        for (std::size_t i = at; i < at + kBlock; ++i)
            refused = static_cast<unsigned char>(refused | (is_refused(text[i]) ? 1 : 0));
        if (refused != 0) break;
    }
    while (at < text.size() && !is_refused(text[at])) {
        ++at;
    }
    if (at == text.size()) {
        return;
    }
    int line = 1;
    for (std::size_t i = 0; i < at; ++i) {
        line += text[i] == '\n' || (text[i] == '\r' && text[i + 1] != '\n') ? 1 : 0;
    }
    fail_at(
        path, line,
        fmt::format("control character 0x{:02x}: this is not a text file", static_cast<unsigned>(text[at]) & 0xffu));
}

std::optional<double> parse_number(std::string_view word) {
    if (word.starts_with('+') && word.size() > 1 && word[1] != '-') {
        word.remove_prefix(1);
    }
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) {
        return std::nullopt;
    }
    if (error == std::errc::result_out_of_range) {
        return is_underflow(word) ? std::optional<double>(0.0) : std::nullopt;
    }
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        return std::nullopt;
    }
    return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    if (word.starts_with('+') && word.size() > 1 && word[1] != '-') {
        word.remove_prefix(1);
    }
    std::int64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return stop == end && error == std::errc{} ? std::optional<std::int64_t>(value) : std::nullopt;
}

std::string_view take_word(std::string_view& text) {
    const char* const end = text.data() + text.size();
    const char* const begin = skip_blanks(text.data(), end);
    const char* const stop = begin != end && *begin == '#' ? begin : skip_word(begin, end);
    text = between(begin == stop ? end : skip_blanks(stop, end), end);
    return between(begin, stop);
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
        words.push_back(word);
    }
    return words;
}

std::string lower_case(std::string_view word) {
    std::string lower(word);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

std::string in_quotes(std::string_view word, std::size_t limit) {
    std::string shown(word.substr(0, limit));
    for (char& c : shown) {
        c = is_control(c) ? '?' : c;
    }
    return fmt::format("'{}{}'", shown, word.size() > limit ? "..." : "");
}

LineReader::LineReader(std::string_view text, int lines_before)
    : at_(text.data()), end_(at_ + text.size()), feed_(find('\n', at_, end_)), return_(find('\r', at_, end_)),
      lines_taken_(lines_before) {}

bool LineReader::next() {
    while (at_ != end_) {
        line_ = lines_taken_ + 1;
        std::string_view line = take_line();
        const char* begin = line.data();
        const char* end = begin + line.size();
        begin = skip_blanks(begin, end);
        if (begin == end || *begin == '#') {
            continue;  // a backslash at the end of a comment is part of it
        }
        if (end[-1] == '\\') {
            line = join(line);
            end = line.data() + line.size();
            begin = skip_blanks(line.data(), end);
        }
        const char* const keyword_end = skip_word(begin, end);
        const char* const arguments = skip_blanks(keyword_end, end);
        while (end != arguments && is_blank(end[-1])) {
            --end;
        }
        keyword_ = between(begin, keyword_end);
        arguments_ = between(arguments, end);
        if (!keyword_.empty()) {
            return true;
        }
    }
    return false;
}

/// The next line, without its end.
std::string_view LineReader::take_line() {
    feed_ = feed_ < at_ ? find('\n', at_, end_) : feed_;
    return_ = return_ < at_ ? find('\r', at_, end_) : return_;
    const std::string_view line = between(at_, std::min(feed_, return_));
    const char* const last = feed_ - return_ == 1 ? feed_ : line.data() + line.size();  // CR LF is one end
    at_ = last == end_ ? end_ : last + 1;
    ++lines_taken_;
    return line;
}

/// A line that ends with a backslash, with the lines that continue it.
std::string_view LineReader::join(std::string_view line) {
    joined_.clear();
    while (line.ends_with('\\')) {
        joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = take_line();
    }
    return joined_.append(line);
}

}  // namespace pl
