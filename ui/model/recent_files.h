// The scenes opened last, by name or file.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace pl::ui {

class RecentFiles {
public:
    static constexpr std::size_t kMost = 10;

    /// To the front; a name that is there already moves.
    void add(const std::string& name) {
        std::erase(names_, name);
        names_.insert(names_.begin(), name);
        if (names_.size() > kMost) names_.resize(kMost);
    }
    /// Newest first, without duplicates, kMost of them.
    const std::vector<std::string>& names() const { return names_; }
    /// As names() gave them in another session; those that break its rules are dropped.
    void set(const std::vector<std::string>& names) {
        names_.clear();
        for (auto name = names.rbegin(); name != names.rend(); ++name) add(*name);
    }

private:
    std::vector<std::string> names_;
};

}  // namespace pl::ui
