#include "core/diagnose/path_record.h"

namespace pl::diagnose {

std::string_view name_of(Technique technique) {
    switch (technique) {
    case Technique::Bsdf: return "bsdf";
    case Technique::Field: return "field";
    case Technique::Delta: return "delta";
    }
    return "bsdf";
}

std::string_view name_of(PathEnd end) {
    switch (end) {
    case PathEnd::Escaped: return "escaped";
    case PathEnd::Absorbed: return "absorbed";
    case PathEnd::Roulette: return "roulette";
    case PathEnd::DepthLimit: return "depth-limit";
    case PathEnd::ZeroDirection: return "zero-direction";
    }
    return "absorbed";
}

}  // namespace pl::diagnose
