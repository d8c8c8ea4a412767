#include "ui/model/programs.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
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
    explicit Streams(const std::filesystem::path& input) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
        for (const int output : {STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_addopen(&actions_, output, "/dev/null", O_WRONLY, 0);
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

/// Of a desktop of Wayland if this is one; each of them takes the picture from its standard input.
std::vector<std::pair<std::string, std::vector<std::string>>> copying_programs() {
    const std::pair<std::string, std::vector<std::string>> wayland{"wl-copy", {"--type", "image/png"}};
    const std::pair<std::string, std::vector<std::string>> x11{"xclip",
                                                               {"-selection", "clipboard", "-t", "image/png"}};
    return std::getenv("WAYLAND_DISPLAY") != nullptr ? std::vector{wayland, x11} : std::vector{x11, wayland};
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
                 const std::filesystem::path& input) {
    std::string name = program.string();
    std::vector<std::string> texts = arguments;
    std::vector<char*> argv{name.data()};
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    const Streams streams(input);
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
    for (const auto& [name, arguments] : copying_programs())
        if (const std::filesystem::path program = find_program(name); !program.empty())
            return run_program(program, arguments, png);
    throw Error(ErrorKind::Unavailable, "a picture cannot be copied: install wl-clipboard (Wayland) or xclip (X11)");
}

}  // namespace pl::ui
