// Options whose values are names of an enumeration: their words, in one table each.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/choices.h"
#include "app/option_parsers.h"

namespace pl {
namespace {

/// A value and its name.
template <class Value>
struct Named {
    Value value;
    std::string_view name;
};
constexpr std::array kCurves{Named<ToneCurve>{ToneCurve::Clamp, "clamp"},
                             Named<ToneCurve>{ToneCurve::Reinhard, "reinhard"},
                             Named<ToneCurve>{ToneCurve::Aces, "aces"}};
constexpr std::array kRates{Named<LearningRate>{LearningRate::SampleMean, "mean"},
                            Named<LearningRate>{LearningRate::Forgetful, "forgetful"}};
constexpr std::array kRepresentations{
    Named<Representation>{Representation::Table, "table"}, Named<Representation>{Representation::SdTree, "sd-tree"},
    Named<Representation>{Representation::Lobes, "lobes"}, Named<Representation>{Representation::Neural, "neural"}};
constexpr std::array kTargets{Named<LearningTarget>{LearningTarget::ExpectedSarsa, "expected-sarsa"},
                              Named<LearningTarget>{LearningTarget::Sarsa, "sarsa"},
                              Named<LearningTarget>{LearningTarget::MonteCarlo, "monte-carlo"}};
constexpr std::array kLights{Named<LearnedLight>{LearnedLight::All, "all"},
                             Named<LearnedLight>{LearnedLight::Indirect, "indirect"}};
constexpr std::array kRoulettes{Named<RouletteRule>{RouletteRule::Spare, "spare"},
                                Named<RouletteRule>{RouletteRule::Albedo, "albedo"},
                                Named<RouletteRule>{kNoRoulette, "off"}};
constexpr std::array kGuidings{Named<GuidingRule>{GuidingRule::Paying, "paying"},
                               Named<GuidingRule>{GuidingRule::Always, "always"}};
constexpr std::array kImageKinds{Named<ImageKind>{ImageKind::Png, name_of(ImageKind::Png)},
                                 Named<ImageKind>{ImageKind::Exr, name_of(ImageKind::Exr)},
                                 Named<ImageKind>{ImageKind::Pfm, name_of(ImageKind::Pfm)}};

template <class Value, std::size_t kCount>
void parse_named(Value& value, const std::array<Named<Value>, kCount>& names, const std::string& text) {
    for (const Named<Value>& known : names) {
        if (known.name == text) {
            value = known.value;
            return;
        }
    }
    fail_choice(names_in(names, [](const Named<Value>& known) { return known.name; }), text);
}

template <class Value, std::size_t kCount>
std::string_view name_in(const std::array<Named<Value>, kCount>& names, Value value) {
    for (const Named<Value>& known : names)
        if (known.value == value) return known.name;
    return "";
}

}  // namespace

void parse_tone_curve(Options& options, const std::string& text) {
    parse_named(options.display.curve, kCurves, text);
}

void parse_representation(Options& options, const std::string& text) {
    parse_named(options.render.field.representation, kRepresentations, text);
}
void parse_representations(Options& options, const std::string& text) {
    options.fields.clear();
    for (const std::string& name : split_at_commas(text)) {
        Representation field{};
        parse_named(field, kRepresentations, name);
        if (std::ranges::find(options.fields, field) == options.fields.end()) options.fields.push_back(field);
    }
}
void parse_learning_rate(Options& options, const std::string& text) {
    parse_named(options.render.field.rate, kRates, text);
}
void parse_learn_target(Options& options, const std::string& text) {
    parse_named(options.render.field.learning.target, kTargets, text);
}
void parse_learn_from(Options& options, const std::string& text) {
    parse_named(options.render.field.learning.light, kLights, text);
}
void parse_roulette(Options& options, const std::string& text) {
    parse_named(options.render.roulette, kRoulettes, text);
}

void parse_guiding(Options& options, const std::string& text) {
    parse_named(options.render.guiding, kGuidings, text);
}

void parse_frame_kind(Options& options, const std::string& text) {
    parse_named(options.frame_kind, kImageKinds, text);
}

std::string_view tone_curve_name(ToneCurve curve) { return name_in(kCurves, curve); }

std::string_view name_of(Representation representation) { return name_in(kRepresentations, representation); }
std::string print_representations(const Options& options) {
    if (options.fields.empty()) return std::string(name_of(options.render.field.representation));
    std::vector<std::string_view> names;
    for (const Representation field : options.fields) names.push_back(name_of(field));
    return fmt::format("{}", fmt::join(names, ","));
}
std::string_view name_of(LearningRate rate) { return name_in(kRates, rate); }
std::string_view name_of(LearningTarget target) { return name_in(kTargets, target); }
std::string_view name_of(LearnedLight light) { return name_in(kLights, light); }
std::string_view name_of(RouletteRule rule) { return name_in(kRoulettes, rule); }
std::string_view name_of(GuidingRule rule) { return name_in(kGuidings, rule); }

}  // namespace pl
