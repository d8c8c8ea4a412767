// Programs of others that are called where they are installed: films by ffmpeg, pictures on the clipboard by wl-clipboard or
// xclip.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pl::ui {

/// Full path of a program in PATH; empty if it is not installed.
std::filesystem::path find_program(std::string_view name);

/// Runs a program to its end, with files or nothing as its input and output. Throws Error(Unavailable) if it cannot be run,
/// Error(Runtime) if its exit status is not 0.
void run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& input = "/dev/null", const std::filesystem::path& output = "/dev/null");

/// Makes FOLDER.mp4 from the frames of a folder (frame_file()), so many a second; both stay. Returns what there is now, in one sentence. Throws as
/// run_program().
std::string make_film(const std::filesystem::path& folder, int frames_per_second);

/// Copies a PNG file to the clipboard of the desktop. Throws Error(Unavailable) if no program for it is installed, else as run_program().
void copy_picture(const std::filesystem::path& png);
/// Writes the picture on the clipboard to a PNG file. False if there is none. Throws Error(Unavailable) if no program for it is installed.
bool paste_picture(const std::filesystem::path& png);

}  // namespace pl::ui
