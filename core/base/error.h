// The one exception type. `kind` decides the exit code; the message says what, where, expected, got.
#pragma once

#include <stdexcept>
#include <string>

namespace pl {

/// Exit codes of the program (see README, "Exit codes").
enum class ErrorKind {
    Runtime = 1,      ///< something failed while working (disk full, ...)
    Usage = 2,        ///< the command line is wrong
    Input = 3,        ///< a file is missing or invalid
    Unavailable = 4,  ///< back end, device or display is not there
    Threshold = 5,    ///< a threshold asked for was missed
};

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

}  // namespace pl
