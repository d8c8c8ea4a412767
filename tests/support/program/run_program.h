// Runs the built program as a shell would, and a folder to do it in.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pl::test {

/// A new, empty folder, removed with all it holds.
class TempDir {
public:
    TempDir();
    ~TempDir();
    TempDir(const TempDir&) = delete;
    TempDir& operator=(const TempDir&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Path of a file in the folder.
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    /// Names of all that is there, hidden ones included, sorted.
    std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

struct ProgramResult {
    int code = -1;  ///< exit code; 128 + number for a signal
    std::string out;
    std::string err;
};

using Arguments = std::vector<std::string>;

Arguments joined(Arguments arguments, const Arguments& more);

/// The built program's path, and its arguments.
Arguments program(const Arguments& arguments);

/// How the program is started.
struct ProgramSetup {
    std::filesystem::path folder{};    ///< working directory; empty: this one
    std::vector<std::string> unset{};  ///< environment variables that it does not get
    std::vector<std::string> set{};    ///< "NAME=value"
    std::string terminal{};            ///< device that standard error goes to instead of a file
    std::string output_device{};       ///< that standard output goes to instead of a file
};

/// A running program. Its output goes to files, so that it never has to wait for a reader.
class RunningProgram {
public:
    explicit RunningProgram(Arguments command, const ProgramSetup& setup = {});
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    void send(int signal) const;
    /// Standard output so far.
    std::string out() const;
    /// Standard error so far, if it goes to no terminal.
    std::string err() const;
    /// Waits until `holds()`; false if the program ends first. A program that hangs is stopped by the time limit of ctest.
    bool wait_until(const std::function<bool()>& holds);
    /// Waits until standard output holds `text`.
    bool wait_for_output(const std::string& text);
    ProgramResult wait();

private:
    bool has_ended();

    TempDir folder_;
    pid_t process_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

ProgramResult run_program(const Arguments& arguments, const ProgramSetup& setup = {});

/// Runs a shell command line in which `pathlight` is the program.
ProgramResult run_shell(const std::string& command, const ProgramSetup& setup = {});

std::string read_all(const std::filesystem::path& path);
void write_all(const std::filesystem::path& path, const std::string& text);
std::vector<std::string> lines_of(const std::string& text);

}  // namespace pl::test
