// Logical lines of OBJ and MTL text, and the numbers in them, with the line every complaint belongs to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pl {

/// "file:line", the way every message of a loader starts.
std::string place(const std::filesystem::path& path, int line);

/// Throws Error(Input) "file:line: what".
[[noreturn]] void fail_at(const std::filesystem::path& path, int line, const std::string& what);

/// Number in C syntax, whole word, independent of the locale: no hex, no "inf", no "nan". What is too small for a
/// double reads as 0. Nothing if the word is no number or its magnitude exceeds the largest float.
std::optional<double> parse_number(std::string_view word);

/// Decimal integer, whole word. Nothing if it is none or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Words separated by blanks; a word that starts with '#' begins a comment.
std::vector<std::string_view> split_words(std::string_view text);

/// At most `limit` characters of a word, for messages: what cannot be printed becomes '?'.
std::string in_quotes(std::string_view word, std::size_t limit = 40);

/// Steps through the statements of a text: ends of line LF, CR LF or CR, a backslash at the end continues the
/// line, empty lines and comment lines are left out. Control characters are an error: the file is binary.
class LineReader {
public:
    LineReader(std::string_view text, std::filesystem::path path) : text_(text), path_(std::move(path)) {}

    /// False at the end of the text.
    bool next();

    int line() const { return line_; }                         ///< where the statement starts, from 1
    std::string_view keyword() const { return keyword_; }      ///< first word
    std::string_view arguments() const { return arguments_; }  ///< the rest, trimmed
    [[noreturn]] void fail(const std::string& what) const { fail_at(path_, line_, what); }

private:
    std::string_view take_line();
    void split(std::string_view statement);

    std::string_view text_;
    std::filesystem::path path_;
    std::string joined_;
    std::string_view keyword_;
    std::string_view arguments_;
    int line_ = 0;
    int lines_taken_ = 0;
};

}  // namespace pl
