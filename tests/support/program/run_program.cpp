#include "tests/support/program/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace pl::test {
namespace {

namespace fs = std::filesystem;

bool names_variable(const std::string& entry, const std::string& name) { return entry.starts_with(name + "="); }

std::vector<std::string> environment_of(const ProgramSetup& setup) {
    std::vector<std::string> entries;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const bool unset = std::any_of(setup.unset.begin(), setup.unset.end(),
                                       [&](const std::string& name) { return names_variable(*entry, name); });
        const bool replaced = std::any_of(setup.set.begin(), setup.set.end(), [&](const std::string& other) {
            return names_variable(*entry, other.substr(0, other.find('=')));
        });
        if (!unset && !replaced) entries.emplace_back(*entry);
    }
    entries.insert(entries.end(), setup.set.begin(), setup.set.end());
    return entries;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

pid_t start(std::vector<std::string> command, const ProgramSetup& setup, const std::string& out,
            const std::string& err) {
    std::vector<std::string> environment = environment_of(setup);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (!setup.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, setup.folder.c_str());
    pid_t process = -1;
    const int failed = posix_spawn(&process, command.front().c_str(), &actions, nullptr, pointers_to(command).data(),
                                   pointers_to(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + command.front());
    return process;
}

}  // namespace

TempDir::TempDir() {
    std::string name = (fs::temp_directory_path() / "pathlight-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
}

TempDir::~TempDir() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<std::string> TempDir::names() const {
    std::vector<std::string> result;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_))
        result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
}

Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

Arguments program(const Arguments& arguments) {
    Arguments command{PL_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

RunningProgram::RunningProgram(Arguments command, const ProgramSetup& setup) {
    process_ = start(std::move(command), setup, setup.output_device.empty() ? folder_ / "out" : setup.output_device,
                     setup.terminal.empty() ? folder_ / "err" : setup.terminal);
}

RunningProgram::~RunningProgram() {
    if (!has_ended()) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

std::string RunningProgram::out() const { return read_all(folder_ / "out"); }
std::string RunningProgram::err() const { return read_all(folder_ / "err"); }

bool RunningProgram::has_ended() {
    if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) == process_;
    return ended_;
}

bool RunningProgram::wait_until(const std::function<bool()>& holds) {
    using namespace std::chrono_literals;
    while (!holds()) {
        if (has_ended()) return holds();
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

bool RunningProgram::wait_for_output(const std::string& text) {
    return wait_until([&] { return out().find(text) != std::string::npos; });
}

ProgramResult RunningProgram::wait() {
    if (!ended_) ended_ = waitpid(process_, &status_, 0) == process_;
    const int code = WIFSIGNALED(status_) ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
    return {.code = code, .out = out(), .err = err()};
}

ProgramResult run_program(const Arguments& arguments, const ProgramSetup& setup) {
    return RunningProgram(program(arguments), setup).wait();
}

ProgramResult run_shell(const std::string& command, const ProgramSetup& setup) {
    const std::string define = std::string("pathlight() { '") + PL_PROGRAM + "' \"$@\"; }; ";
    return RunningProgram({"/bin/sh", "-c", define + command}, setup).wait();
}

std::string read_all(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void write_all(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace pl::test
