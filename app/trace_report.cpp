#include "app/trace_report.h"

#include <fmt/format.h>

#include "app/parse_values.h"
#include "core/diagnose/pixel_paths.h"
#include "core/session/methods.h"

namespace pl {
namespace {

std::string surface_text(const diagnose::VertexRecord& vertex, const SceneDescription& scene) {
    std::string text =
        fmt::format("  position    {}, distance {}\n", print_vector(vertex.position), print_float(vertex.distance));
    text += fmt::format("  normal      {}", print_vector(vertex.geometric_normal));
    if (vertex.shading_normal != vertex.geometric_normal)
        text += fmt::format(", shading {}", print_vector(vertex.shading_normal));
    text += fmt::format("\n  material    {}, albedo {}", scene.materials[vertex.material].name,
                        print_vector(vertex.albedo));
    if (vertex.delta_probability > 0.0f)
        text += fmt::format(", delta lobe with probability {}", print_float(vertex.delta_probability));
    if (vertex.volume != kNoVolume)
        text += fmt::format("\n  volume      {}, BSDF fraction {}", vertex.volume, print_float(vertex.bsdf_fraction));
    return text + "\n";
}

std::string emission_text(const diagnose::EmissionRecord& emission) {
    if (is_black(emission.radiance)) return "";
    return fmt::format("  emission    {}, MIS weight {}, light pdf {}: contributes {}\n",
                       print_vector(emission.radiance), print_float(emission.weight),
                       print_float(emission.light_pdf_sa), print_vector(emission.contribution));
}

std::string light_text(const diagnose::LightSampleRecord& light) {
    const std::string place = light.position
                                  ? fmt::format("{} on triangle {}", print_vector(*light.position), light.primitive)
                                  : std::string("far away");
    return fmt::format("  light       {}, wi {}\n              pdf {}, scattering pdf {}, MIS weight {}, {}: "
                       "contributes {}\n",
                       place, print_vector(light.wi), print_float(light.pdf_sa), print_float(light.scatter_pdf_sa),
                       print_float(light.weight), light.is_visible ? "visible" : "occluded",
                       print_vector(light.contribution));
}

std::string roulette_text(const diagnose::RouletteRecord& roulette) {
    return fmt::format("  roulette    contribution estimate {}, survival probability {}: {}\n",
                       print_float(roulette.estimate), print_float(roulette.survival_probability),
                       roulette.survives ? "continues" : "ends");
}

std::string direction_text(const diagnose::ScatterRecord& direction) {
    std::string text =
        fmt::format("  direction   by {}, wi {}\n", name_of(direction.technique), print_vector(direction.wi));
    if (direction.technique != diagnose::Technique::Delta)
        text += fmt::format("              pdf {} (bsdf {}, field {}), f cos {}\n", print_float(direction.pdf_sa),
                            print_float(direction.bsdf_pdf_sa), print_float(direction.field_pdf_sa),
                            print_vector(direction.bsdf_cos));
    return text + fmt::format("              throughput {}\n", print_vector(direction.throughput));
}

std::string vertex_text(const diagnose::VertexRecord& vertex, const SceneDescription& scene) {
    std::string text = fmt::format("\n  wo          {}\n  throughput  {}\n", print_vector(vertex.wo),
                                   print_vector(vertex.throughput));
    if (!vertex.is_escape) text += surface_text(vertex, scene);
    text += emission_text(vertex.emission);
    if (vertex.target) text += fmt::format("  trains      the direction before by {}\n", print_float(*vertex.target));
    if (vertex.light) text += light_text(*vertex.light);
    if (vertex.roulette) text += roulette_text(*vertex.roulette);
    if (vertex.scattered) text += direction_text(*vertex.scattered);
    return text;
}

Json emission_json(const diagnose::EmissionRecord& emission) {
    return {{"radiance", vector_json(emission.radiance)},
            {"weight", emission.weight},
            {"light_pdf", emission.light_pdf_sa},
            {"contribution", vector_json(emission.contribution)}};
}

Json light_json(const diagnose::LightSampleRecord& light) {
    return {{"position", light.position ? vector_json(*light.position) : Json()},
            {"triangle", light.position ? Json(light.primitive) : Json()},
            {"wi", vector_json(light.wi)},
            {"pdf", light.pdf_sa},
            {"scatter_pdf", light.scatter_pdf_sa},
            {"weight", light.weight},
            {"visible", light.is_visible},
            {"unoccluded", vector_json(light.unoccluded)},
            {"contribution", vector_json(light.contribution)}};
}

Json direction_json(const diagnose::ScatterRecord& direction) {
    return {{"technique", name_of(direction.technique)},
            {"wi", vector_json(direction.wi)},
            {"pdf", direction.pdf_sa},
            {"bsdf_pdf", direction.bsdf_pdf_sa},
            {"field_pdf", direction.field_pdf_sa},
            {"bsdf_cos", vector_json(direction.bsdf_cos)},
            {"throughput", vector_json(direction.throughput)}};
}

Json surface_json(const diagnose::VertexRecord& vertex, const SceneDescription& scene) {
    return {{"position", vector_json(vertex.position)},
            {"geometric_normal", vector_json(vertex.geometric_normal)},
            {"shading_normal", vector_json(vertex.shading_normal)},
            {"distance", vertex.distance},
            {"triangle", vertex.primitive},
            {"material", scene.materials[vertex.material].name},
            {"albedo", vector_json(vertex.albedo)},
            {"delta_probability", vertex.delta_probability},
            {"volume", vertex.volume == kNoVolume ? Json() : Json(vertex.volume)},
            {"bsdf_fraction", vertex.bsdf_fraction}};
}

Json vertex_json(const diagnose::VertexRecord& vertex, const SceneDescription& scene) {
    Json json{{"wo", vector_json(vertex.wo)},
              {"throughput", vector_json(vertex.throughput)},
              {"surface", vertex.is_escape ? Json() : surface_json(vertex, scene)},
              {"emission", emission_json(vertex.emission)},
              {"light", vertex.light ? light_json(*vertex.light) : Json()},
              {"roulette", Json()},
              {"scattered", vertex.scattered ? direction_json(*vertex.scattered) : Json()},
              {"target", vertex.target ? Json(*vertex.target) : Json()},
              {"contribution", vector_json(vertex.contribution())}};
    if (vertex.roulette)
        json["roulette"] = {{"estimate", vertex.roulette->estimate},
                            {"survival_probability", vertex.roulette->survival_probability},
                            {"survives", vertex.roulette->survives}};
    return json;
}

}  // namespace

std::string path_line(const TracedPath& traced) {
    const diagnose::PathRecord& path = traced.path;
    return fmt::format("sample {}: light {}, radiance {}; vertices {}{}; end: {}\n", traced.sample,
                       print_float(diagnose::path_light(path)), print_vector(path.radiance), path.vertices.size(),
                       path.is_guided ? ", guided" : "", name_of(path.end));
}

std::string path_text(const TracedPath& traced) {
    const diagnose::PathRecord& path = traced.path;
    const auto width = static_cast<std::uint32_t>(traced.settings.width);
    std::string text =
        fmt::format("pixel {},{}, sample {}, seed {}, {}{}\n", path.pixel % width, path.pixel / width, traced.sample,
                    traced.settings.seed, info_of(traced.settings.method).name, path.is_guided ? ", guided" : "");
    for (std::size_t i = 0; i < path.vertices.size(); ++i)
        text += fmt::format("vertex {}{}", i, vertex_text(path.vertices[i], traced.scene));
    return text + fmt::format("  end         {}\nradiance {}; segments {}, shadow rays {}\n", label_of(path.end),
                              print_vector(path.radiance), path.segments, path.shadow_rays);
}

Json path_json(const TracedPath& traced) {
    const diagnose::PathRecord& path = traced.path;
    const auto width = static_cast<std::uint32_t>(traced.settings.width);
    Json json{{"method", info_of(traced.settings.method).name},
              {"guided", path.is_guided},
              {"seed", traced.settings.seed},
              {"pixel", {path.pixel % width, path.pixel / width}},
              {"sample", traced.sample},
              {"eye", vector_json(path.eye)},
              {"radiance", vector_json(path.radiance)},
              {"segments", path.segments},
              {"shadow_rays", path.shadow_rays},
              {"vertices", Json::array()},
              {"end", name_of(path.end)}};
    for (const diagnose::VertexRecord& vertex : path.vertices)
        json["vertices"].push_back(vertex_json(vertex, traced.scene));
    return json;
}

}  // namespace pl
