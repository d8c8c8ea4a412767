// The scenes of benchmarks: shipped ones and files, and balls of bumps of any size.
#pragma once

#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"

namespace pl::benchmarks {

/// `name`: as of the command line, or ball:ROWS for write_bumpy_ball() in the open, room:ROWS for the same in a room. Throws
/// Error(Usage) for other numbers of rows than 2 to 9999.
inline SceneDescription open_bench_scene(const std::string& name) {
    const std::filesystem::path assets = PL_SOURCE_DIR "/assets";
    const bool is_open = name.starts_with("ball:");
    if (!is_open && !name.starts_with("room:")) return load_scene(name, assets);
    const std::string_view rows = std::string_view(name).substr(5);
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(rows.data(), rows.data() + rows.size(), count);
    if (error != std::errc() || end != rows.data() + rows.size() || count < 2 || count > 9999)
        throw Error(ErrorKind::Usage, "scene '" + name + "': expected 2 to 9999 rows behind the colon");
    const test::TemporaryFolder folder;
    const auto surroundings = is_open ? test::BallSurroundings::Open : test::BallSurroundings::Room;
    SceneDescription scene = load_scene(test::write_bumpy_ball(folder.path(), count, surroundings).string(), assets);
    if (!is_open) {
        scene.camera.eye = {2.5f, 2.2f, 3.2f};  // inside
        scene.camera.target = {0.0f, 1.1f, 0.0f};
    }
    return scene;
}

}  // namespace pl::benchmarks
