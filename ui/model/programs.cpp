#include "ui/model/programs.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace pl::ui {
namespace {

/// The files of a program, which are not those of this one.
class Streams {
public:
    Streams(const std::filesystem::path& input, const std::filesystem::path& output) {
        constexpr int kWrites = O_WRONLY | O_CREAT | O_TRUNC;
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, output.c_str(), kWrites, S_IRUSR | S_IWUSR);
        posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    }
    ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;

    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

std::string text_of(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    return fmt::format("{} {}", program.filename().string(), fmt::join(arguments, " "));
}

/// A program of the clipboard, with its arguments for pictures.
struct ClipboardProgram {
    std::filesystem::path program;
    std::vector<std::string> arguments;
};

/// The installed one, that of Wayland first on its desktops: takes a picture from its standard input, or writes it to its output.
ClipboardProgram clipboard_program(bool pastes) {
    const ClipboardProgram wayland{find_program(pastes ? "wl-paste" : "wl-copy"), {"--type", "image/png"}};
    const ClipboardProgram x11{find_program("xclip"),
                               {"-selection", "clipboard", "-t", "image/png", pastes ? "-o" : "-i"}};
    const bool is_wayland = std::getenv("WAYLAND_DISPLAY") != nullptr;
    for (const ClipboardProgram& found : is_wayland ? std::array{wayland, x11} : std::array{x11, wayland})
        if (!found.program.empty()) return found;
    throw Error(ErrorKind::Unavailable,
                fmt::format("a picture cannot be {}: install wl-clipboard (Wayland) or xclip (X11)",
                            pastes ? "pasted" : "copied"));
}

}  // namespace

std::filesystem::path find_program(std::string_view name) {
    const char* const folders = std::getenv("PATH");
    std::istringstream stream(folders != nullptr ? folders : "");
    for (std::string folder; std::getline(stream, folder, ':');) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0) return path;
    }
    return {};
}

void run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& input, const std::filesystem::path& output) {
    std::string name = program.string();
    std::vector<std::string> texts = arguments;
    std::vector<char*> argv{name.data()};
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    const Streams streams(input, output);
    pid_t child = 0;
    if (const int error = posix_spawn(&child, name.c_str(), streams.get(), nullptr, argv.data(), environ); error != 0)
        throw Error(ErrorKind::Unavailable, fmt::format("{}: {}", text_of(program, arguments), std::strerror(error)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const bool has_ended = WIFEXITED(status);
    if (!has_ended || WEXITSTATUS(status) != 0)
        throw Error(ErrorKind::Runtime, fmt::format("{}: expected exit status 0, got {}", text_of(program, arguments),
                                                    has_ended ? fmt::format("{}", WEXITSTATUS(status)) : "a signal"));
}

std::string make_film(const std::filesystem::path& folder, int frames_per_second) {
    const std::filesystem::path ffmpeg = find_program("ffmpeg");
    if (ffmpeg.empty())
        return fmt::format("the frames are in {}; ffmpeg, which is not installed, makes films", folder.string());
    const std::string film = folder.string() + ".mp4";
    // Most players show YUV 4:2:0 alone, which needs even sizes.
    run_program(ffmpeg,
                {"-y", "-framerate", fmt::format("{}", frames_per_second), "-i", (folder / "frame_%04d.png").string(),
                 "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", film});
    return fmt::format("the film is {}, its frames are in {}", film, folder.string());
}

void copy_picture(const std::filesystem::path& png) {
    const ClipboardProgram clipboard = clipboard_program(false);
    run_program(clipboard.program, clipboard.arguments, png);
}

bool paste_picture(const std::filesystem::path& png) {
    const ClipboardProgram clipboard = clipboard_program(true);
    try {
        run_program(clipboard.program, clipboard.arguments, "/dev/null", png);
    } catch (const Error&) {
        return false;  // the clipboard has something else
    }
    std::error_code ignored;
    return std::filesystem::file_size(png, ignored) > 0 && !ignored;
}

}  // namespace pl::ui
