#include "core/io/nearest_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pl {

namespace {

constexpr std::size_t kShortestAbbreviation = 3;
constexpr std::size_t kShortestMisspelt = 4;
constexpr std::size_t kLettersPerEdit = 3;
constexpr std::size_t kLongest = 64;  ///< no name is longer; bounds the time for words that are none

/// In small letters, without dashes in front.
std::string plain(std::string_view name) {
    name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
    std::string result;
    for (const char c : name) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Insertions, deletions and replacements of single characters, and swaps of two neighbors, none of them edited twice.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::array<std::vector<std::size_t>, 3> rows;  // of the last two characters of a, and of this one
    for (std::vector<std::size_t>& row : rows) row.resize(b.size() + 1);
    std::iota(rows[1].begin(), rows[1].end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        rows[2][0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = rows[1][j] + (a[i] == b[j] ? 0 : 1);
            rows[2][j + 1] = std::min({replaced, rows[1][j + 1] + 1, rows[2][j] + 1});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                rows[2][j + 1] = std::min(rows[2][j + 1], rows[0][j - 1] + 1);
        }
        std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    }
    return rows[1].back();
}

/// Nothing if the names are not near each other.
std::optional<std::size_t> near_distance(std::string_view name, std::string_view known) {
    const std::string a = plain(name);
    const std::string b = plain(known);
    if (a.empty() || a.size() > kLongest || b.size() > kLongest) return std::nullopt;
    if (a == b) return 0;
    if (a.size() >= kShortestAbbreviation && b.starts_with(a)) return 1;
    const std::size_t longer = std::max(a.size(), b.size());
    const std::size_t distance = edit_distance(a, b);
    if (longer < kShortestMisspelt || kLettersPerEdit * distance > longer) return std::nullopt;
    return distance;
}

}  // namespace

bool is_near(std::string_view name, std::string_view known) { return near_distance(name, known).has_value(); }

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string& candidate : candidates) {
        const std::optional<std::size_t> distance = near_distance(name, candidate);
        if (distance && *distance < best_distance) {
            best = candidate;
            best_distance = *distance;
        }
    }
    return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
    const std::string nearest = nearest_name(name, candidates);
    return nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest);
}

std::string known_names(std::string_view name, const std::vector<std::string>& candidates) {
    const std::string hint = did_you_mean(name, candidates);
    return fmt::format("{} Known are: {}", hint.empty() ? "." : hint, fmt::join(candidates, ", "));
}

}  // namespace pl
