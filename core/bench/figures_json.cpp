#include "core/bench/figures_json.h"

#include <cmath>

namespace pl::bench {

Json clocks_json(const Clocks& clocks, const Json& sums) {
    Json json{{"load", clocks.load},    {"build", clocks.build},           {"upload", clocks.upload},
              {"place", clocks.place},  {"precompute", clocks.precompute}, {"learn", clocks.learn},
              {"render", clocks.render}};
    json.update(sums);
    return json;
}

Clocks clocks_from(const Json& json) {
    return {.load = json.at("load"),
            .build = json.at("build"),
            .upload = json.value("upload", 0.0),
            .place = json.at("place"),
            .precompute = json.at("precompute"),
            .learn = json.at("learn"),
            .render = json.at("render")};
}

Json metrics_json(const Metrics& m) {
    return {{"mse", m.mse},
            {"rmse", m.rmse},
            {"relmse", m.relmse},
            {"mse_trimmed", m.mse_trimmed},
            {"relmse_trimmed", m.relmse_trimmed},
            {"mape", m.mape},
            {"smape", m.smape},
            {"bias", m.bias},
            {"relative_bias", m.relative_bias},
            {"psnr_db", std::isfinite(m.psnr_db) ? Json(m.psnr_db) : Json(nullptr)},
            {"pixels", m.pixels},
            {"invalid_pixels", m.invalid},
            {"invalid_reference_pixels", m.invalid_reference},
            {"epsilon", kEpsilon},
            {"trimmed_share", kTrimmedShare}};
}

Json metric_definitions() {
    return {{"values", "linear radiance before tone mapping; means over channels and pixels"},
            {"epsilon", kEpsilon},
            {"trimmed_share", kTrimmedShare},
            {"mse", "(x-r)^2; against a reference in two halves (x-r1)(x-r2), whose noise drops out"},
            {"relmse", "(x-r)^2 / (r^2 + epsilon)"},
            {"trimmed", "without the trimmed_share of the pixels where it is largest"},
            {"mape", "|x-r| / (|r| + epsilon)"},
            {"smape", "2 |x-r| / (|x| + |r| + epsilon)"},
            {"bias", "luminance of x-r; relative_bias over the mean luminance of r"},
            {"psnr_db", "10 log10(1 / mse)"}};
}

}  // namespace pl::bench
