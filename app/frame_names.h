// Names of the files of a sequence: "frame_%04d.exr".
#pragma once

#include <string>

namespace pl {

class FrameNames {
public:
    /// `pattern` has %d, or %0Nd with N from 1 to 9, once: the place of the frame's number, with at least N digits. Throws
    /// Error(Usage).
    explicit FrameNames(const std::string& pattern);

    /// number >= 0
    std::string name(int number) const;

private:
    std::string before_;
    std::string after_;
    int digits_ = 1;
};

}  // namespace pl
