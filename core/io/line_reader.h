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

/// Throws Error(Input) with file and line for a control character: the file is binary.
void refuse_control_characters(std::string_view text, const std::filesystem::path& path);

/// A whole word as a number in C syntax, independent of the locale; no hex, "inf" or "nan". Values too small for a
/// double read as 0. Nothing if the word is not a number or its magnitude exceeds the largest float.
std::optional<double> parse_number(std::string_view word);

/// A whole word as a decimal integer. Nothing if it is not one or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Removes the first word of a text, with the blanks around it, and returns it. It is empty at the end of the text and at a comment, which
/// begins with a word that starts with '#'.
std::string_view take_word(std::string_view& text);

/// The words of a text up to a comment.
std::vector<std::string_view> split_words(std::string_view text);

/// With the letters A to Z as small ones.
std::string lower_case(std::string_view word);

/// At most `limit` characters of a word in quotes, for messages; unprintable characters become '?'.
std::string in_quotes(std::string_view word, std::size_t limit = 40);

/// Iterates over the statements of a text without control characters: line ends LF, CR LF or CR; a backslash at the end continues the
/// line; empty lines and comments are skipped.
class LineReader {
public:
    /// `lines_before`: of the file before the text, which begins with a line.
    explicit LineReader(std::string_view text, int lines_before = 0);

    /// False at the end of the text.
    bool next();

    int line() const { return line_; }                         ///< of the start of the statement, from 1
    int lines() const { return lines_taken_; }                 ///< of the file, to the end of the statement
    std::string_view keyword() const { return keyword_; }      ///< first word
    std::string_view arguments() const { return arguments_; }  ///< the rest, trimmed

private:
    std::string_view take_line();
    std::string_view join(std::string_view line);

    const char* at_;
    const char* end_;
    const char* feed_;    ///< the next LF, or the end
    const char* return_;  ///< the next CR, or the end
    std::string joined_;
    std::string_view keyword_;
    std::string_view arguments_;
    int line_ = 0;
    int lines_taken_;
};

}  // namespace pl
