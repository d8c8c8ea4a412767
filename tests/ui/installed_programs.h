// Programs that a test has installed: shell scripts in a folder that takes the place of PATH.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/files/temporary_folder.h"

namespace pl::test {

/// While it exists, no other programs are found; their scripts find the programs of the machine.
struct InstalledPrograms {
    TemporaryFolder folder;

    InstalledPrograms() { ::setenv("PATH", folder.path().c_str(), 1); }
    ~InstalledPrograms() { ::setenv("PATH", before_.c_str(), 1); }
    InstalledPrograms(const InstalledPrograms&) = delete;
    InstalledPrograms& operator=(const InstalledPrograms&) = delete;

    void add(const std::string& name, const std::string& script) const {
        const auto file = folder.write(name, "#!/bin/sh\nPATH=\"" + before_ + "\"\n" + script + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }

private:
    std::string before_ = std::getenv("PATH");
};

}  // namespace pl::test
