#include "core/io/exr_layers.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/image.h"
#include "core/io/line_reader.h"

namespace pl {
namespace {

/// From the best to the last choice.
enum class Rank { Default, Combined, Layer, LuminanceChroma, Luminance, Only };

struct Candidate {
    Rank rank = Rank::Default;
    ExrLayer layer;
};

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

/// What follows the last dot of a name, in lower case, and what precedes it.
std::string last_part(std::string_view name) { return in_lower_case(name.substr(name.rfind('.') + 1)); }
std::string prefix_of(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? "" : name.substr(0, dot);
}

/// The names of the layers of a part, each once, in the order of the file.
std::vector<std::string> layers_of(const ExrPart& part) {
    std::vector<std::string> names;
    for (const ExrChannel& channel : part.channels)
        if (const std::string name = prefix_of(channel.name);
            std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    return names;
}

const ExrChannel* find_channel(const ExrPart& part, const std::string& layer, std::string_view component) {
    for (const ExrChannel& channel : part.channels)
        if (channel.is_float && prefix_of(channel.name) == layer && last_part(channel.name) == component)
            return &channel;
    return nullptr;
}

/// The full channel of a layer, "" without one.
std::string full_channel(const ExrPart& part, const std::string& layer, std::string_view component) {
    const ExrChannel* const channel = find_channel(part, layer, component);
    return channel == nullptr || channel->is_subsampled ? "" : channel->name;
}

std::optional<Candidate> candidate_of(const ExrPart& part, int number, const std::string& name) {
    ExrLayer layer{.part = number, .name = name, .channels = {}, .alpha = full_channel(part, name, "a")};
    for (std::size_t i = 0; i < 3; ++i)
        layer.channels[i] = full_channel(part, name, std::string_view("rgb").substr(i, 1));
    if (std::none_of(layer.channels.begin(), layer.channels.end(),
                     [](const std::string& channel) { return channel.empty(); })) {
        const Rank rank = name.empty() ? Rank::Default : last_part(name) == "combined" ? Rank::Combined : Rank::Layer;
        return Candidate{rank, layer};
    }
    const std::string luminance = full_channel(part, name, "y");
    if (luminance.empty()) return std::nullopt;
    layer.channels.fill(luminance);
    layer.is_luminance_chroma =
        find_channel(part, name, "ry") != nullptr && find_channel(part, name, "by") != nullptr;
    return Candidate{layer.is_luminance_chroma ? Rank::LuminanceChroma : Rank::Luminance, layer};
}

/// The only channel of a file.
std::optional<Candidate> only_channel(const std::vector<ExrPart>& parts) {
    if (parts.size() != 1 || parts[0].is_deep || parts[0].channels.size() != 1) return std::nullopt;
    const ExrChannel& channel = parts[0].channels[0];
    if (!channel.is_float || channel.is_subsampled) return std::nullopt;
    ExrLayer layer{.name = prefix_of(channel.name), .channels = {}};
    layer.channels.fill(channel.name);
    return Candidate{Rank::Only, layer};
}

std::vector<Candidate> candidates_of(const std::vector<ExrPart>& parts) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].is_deep) continue;
        for (const std::string& name : layers_of(parts[i]))
            if (auto candidate = candidate_of(parts[i], static_cast<int>(i), name))
                candidates.push_back(std::move(*candidate));
    }
    if (candidates.empty())
        if (auto only = only_channel(parts)) candidates.push_back(std::move(*only));
    return candidates;
}

std::string words_of(const ExrLayer& layer, const std::vector<ExrPart>& parts) {
    const std::string words = layer.name.empty() ? "the layer without a name" : "the layer " + in_quotes(layer.name);
    if (parts.size() == 1) return words;
    const std::string& part = parts[static_cast<std::size_t>(layer.part)].name;
    return fmt::format("{} of part {}{}", words, layer.part + 1, part.empty() ? "" : ", " + in_quotes(part));
}

[[noreturn]] void fail_without_candidate(const std::vector<ExrPart>& parts, const std::filesystem::path& path) {
    constexpr std::size_t kMostShown = 8;
    std::vector<std::string> got;
    for (const ExrPart& part : parts)
        for (const ExrChannel& channel : part.channels)
            got.push_back(in_quotes(channel.name) + (part.is_deep            ? " (deep)"
                                                     : !channel.is_float     ? " (whole numbers)"
                                                     : channel.is_subsampled ? " (subsampled)"
                                                                             : ""));
    if (got.size() > kMostShown) {
        got.resize(kMostShown);
        got.emplace_back("...");
    }
    fail_image(path, fmt::format("expected the channels R, G and B, or Y, or a single one, got {}",
                                 got.empty() ? "none" : fmt::format("{}", fmt::join(got, ", "))));
}

}  // namespace

ExrLayer choose_exr_layer(const std::vector<ExrPart>& parts, const std::filesystem::path& path) {
    const std::vector<Candidate> candidates = candidates_of(parts);
    if (candidates.empty()) fail_without_candidate(parts, path);
    const auto best = std::min_element(candidates.begin(), candidates.end(),
                                       [](const Candidate& a, const Candidate& b) { return a.rank < b.rank; });
    ExrLayer layer = best->layer;
    // Layers beside that without a name are no other picture: they are what it is made of.
    const auto others = std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
        return best->rank == Rank::Default ? candidate.rank == Rank::Default : true;
    });
    if (others > 1) layer.note = fmt::format("of its {} layers, {} is shown", others, words_of(layer, parts));
    return layer;
}

}  // namespace pl
