// The number of a name in a list of different ones.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace pl {

/// The number of a name in a list, to which it is added if it is new.
class NameIndex {
public:
    /// Calls add() for a new name.
    template <class Add>
    std::uint32_t find_or(const std::string& name, Add&& add) {
        const auto [entry, is_new] = index_.try_emplace(name, static_cast<std::uint32_t>(index_.size()));
        if (is_new) {
            add();
        }
        return entry->second;
    }

private:
    std::map<std::string, std::uint32_t> index_;
};

}  // namespace pl
