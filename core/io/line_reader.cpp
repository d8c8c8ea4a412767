#include "core/io/line_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
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

void refuse_control_characters(std::string_view text, const std::filesystem::path& path, int line) {
    char last = 0;
    for (const char c : text) {
        if (c == '\r' || c == '\n') {
            line += c == '\n' && last == '\r' ? 0 : 1;
        } else if (is_control(c)) {
            fail_at(
                path, line,
                fmt::format("control character 0x{:02x}: this is not a text file", static_cast<unsigned>(c) & 0xffu));
        }
        last = c;
    }
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

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    std::size_t at = text.find_first_not_of(kBlanks);
    while (at != std::string_view::npos && text[at] != '#') {
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(kBlanks, end);
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

bool LineReader::next() {
    while (!text_.empty()) {
        line_ = lines_taken_ + 1;
        std::string_view statement = take_line();
        const std::string_view start = trim(statement);
        if (start.starts_with('#')) {
            continue;  // a backslash at the end of a comment is part of it
        }
        if (statement.ends_with('\\')) {
            joined_.clear();
            while (statement.ends_with('\\')) {
                joined_.append(statement.substr(0, statement.size() - 1)).push_back(' ');
                statement = take_line();
            }
            statement = joined_.append(statement);
        }
        split(trim(statement));
        if (!keyword_.empty()) {
            return true;
        }
    }
    return false;
}

std::string_view LineReader::take_line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
    const std::string_view line = text_.substr(0, end);
    const bool pair = text_.substr(end).starts_with("\r\n");
    text_.remove_prefix(std::min(end + (pair ? 2 : 1), text_.size()));
    ++lines_taken_;
    refuse_control_characters(line, path_, lines_taken_);
    return line;
}

void LineReader::split(std::string_view statement) {
    const std::size_t end = std::min(statement.find_first_of(kBlanks), statement.size());
    keyword_ = statement.substr(0, end);
    arguments_ = trim(statement.substr(end));
}

}  // namespace pl
