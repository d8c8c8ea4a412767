// The exception type of the program. `kind` decides the exit code; the message names subject, place, expected and
// actual value.
#pragma once

#include <stdexcept>
#include <string>

namespace pl {

/// Exit codes of the program (see README, "Exit codes").
enum class ErrorKind {
    Runtime = 1,      ///< failure during the work: disk full, device lost
    Usage = 2,        ///< the command line is wrong
    Input = 3,        ///< a file is missing or invalid
    Unavailable = 4,  ///< back end, device or display is missing
    Threshold = 5,    ///< a requested threshold was missed
};

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

}  // namespace pl
