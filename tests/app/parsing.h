// Parsing of options against a scene without settings.
#pragma once

#include <wordexp.h>

#include "app/options.h"
#include "core/base/error.h"
#include "tests/support/catch.hpp"

namespace pl::test {

inline SceneDescription plain_scene() {
    SceneDescription scene;
    scene.name = "plain";
    scene.camera = {.eye = {1, 2, 3}, .target = {4, 5, 6}, .up = {0, 1, 0}, .fov_deg = 50};
    return scene;
}

inline Options parse(const std::vector<std::string>& arguments, const SceneDescription& scene = plain_scene()) {
    const CommandLine line = parse_command_line(arguments);
    REQUIRE_FALSE(line.answer);
    return resolve_options(line, scene);
}

/// The words of a command as a shell splits it.
inline std::vector<std::string> shell_words(const std::string& command) {
    wordexp_t words{};
    REQUIRE(wordexp(command.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) == 0);
    std::vector<std::string> result(words.we_wordv, words.we_wordv + words.we_wordc);
    wordfree(&words);
    return result;
}

/// The message of the usage error that the arguments cause; "nothing" if they cause none.
inline std::string complaint(const std::vector<std::string>& arguments) {
    try {
        parse(arguments);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Usage);
        return error.what();
    }
    return "nothing";
}

}  // namespace pl::test
