// Tokenizer of OBJ and MTL text: logical lines, words and numbers, with line numbers for error messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pl {

/// "file:line", the beginning of every message of a loader.
std::string place(const std::filesystem::path& path, int line);

/// Throws Error(Input) "file:line: what".
[[noreturn]] void fail_at(const std::filesystem::path& path, int line, const std::string& what);

/// Throws Error(Input) with file and line for a control character in a text that begins with a line: the file is binary.
void refuse_control_characters(std::string_view text, const std::filesystem::path& path, int line);

/// A whole word as a number in C syntax, independent of the locale; no hex, "inf" or "nan". Values too small for a
/// double read as 0. Nothing if the word is not a number or its magnitude exceeds the largest float.
std::optional<double> parse_number(std::string_view word);

/// A whole word as a decimal integer. Nothing if it is not one or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Words separated by blanks; a word that starts with '#' begins a comment.
std::vector<std::string_view> split_words(std::string_view text);

/// With the letters A to Z as small ones.
std::string lower_case(std::string_view word);

/// At most `limit` characters of a word in quotes, for messages; unprintable characters become '?'.
std::string in_quotes(std::string_view word, std::size_t limit = 40);

/// Iterates over the statements of a text: line ends LF, CR LF or CR; a backslash at the end continues the line;
/// empty lines and comments are skipped. Control characters are an error.
class LineReader {
public:
    LineReader(std::string_view text, std::filesystem::path path) : text_(text), path_(std::move(path)) {}

    /// False at the end of the text.
    bool next();

    int line() const { return line_; }                         ///< of the start of the statement, from 1
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
