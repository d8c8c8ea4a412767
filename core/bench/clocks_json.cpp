#include "core/bench/clocks_json.h"

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

}  // namespace pl::bench
