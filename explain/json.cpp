#include "explain/json.h"

#include "explain/factors.h"
#include "explain/names.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace explain {

namespace {

using Json = nlohmann::ordered_json;

Json of(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

Json of(const std::optional<double>& x)
{
    return x ? Json(*x) : Json(nullptr);
}

Json of_pixel(std::uint32_t pixel, const ref::World& world)
{
    const auto width = static_cast<std::uint32_t>(world.camera.width());
    return {pixel % width, pixel / width};
}

Json of(const Draw& draw)
{
    Json use;
    Json words;
    for (std::size_t i = 0; i < 4; ++i) {
        use.push_back(draw.use[i] != nullptr ? Json(draw.use[i]) : Json(nullptr));
        // The inverse of ref::uniforms, exact.
        words.push_back(static_cast<std::uint32_t>(draw.uniforms[i] * 0x1p32 - 0.5));
    }
    return {{"event", name_of(draw.event)},
            {"vertex", draw.vertex},
            {"words", words},
            {"uniforms", draw.uniforms},
            {"use", use}};
}

Json of(const ref::World& world, const ref::Vertex& vertex)
{
    Json json = {{"on", describe(world.scene, vertex)}};
    if (vertex.kind == ref::Vertex::Kind::infinity)
        json["towards"] = of(vertex.towards);
    else
        json["position"] = of(vertex.point.position);
    if (vertex.kind == ref::Vertex::Kind::surface) {
        json["normal"] = of(vertex.point.normal);
        json["primitive"] = vertex.point.primitive;
        json["material"] = world.scene.material_names[vertex.point.material];
    }
    return json;
}

Json of(const ref::World& world, const Walk& walk)
{
    Json vertices = Json::array();
    for (const Step& step : walk.steps) {
        Json json = of(world, step.vertex);
        json["alpha"] = of(step.vertex.alpha);
        json["pdf_solid_angle"] = of(step.pdf_solid_angle);
        json["pdf_area"] = of(step.pdf_area);
        json["probability"] = of(step.probability);
        if (step.bounce)
            json["bounce"] = {{"wi", of(step.bounce->wi)},
                              {"delta", step.bounce->sample.delta},
                              {"weight", of(step.bounce->sample.value)},
                              {"pdf_fwd", step.bounce->sample.pdf_fwd},
                              {"pdf_rev", step.bounce->sample.pdf_rev},
                              {"survival", step.bounce->survival},
                              {"survives", step.bounce->survives}};
        vertices.push_back(json);
    }
    return {{"end", name_of(walk.end)}, {"vertices", vertices}};
}

/// The densities of all strategies, and the factors that they are products of.
void add_densities(Json& json, const Strategy& strategy)
{
    Json densities = Json::array();
    for (const Density& density : strategy.densities)
        densities.push_back(
            {{"s", density.s},
             {"p", static_cast<double>(density.value)},
             {"log10_p", density.value > 0.0L ? Json(static_cast<double>(std::log10(density.value)))
                                              : Json(nullptr)},
             {"relative", density.relative}});
    json["densities"] = densities;
    if (!strategy.p) return;
    json["vertex_densities"] = {{"light", strategy.p->light}, {"eye", strategy.p->eye}};
}

Json of(const ref::World& world, const Sample& sample, const Strategy& strategy)
{
    Json json = {{"s", strategy.s},
                 {"t", strategy.t},
                 {"family", family_of(strategy)},
                 {"obstacle", name_of(strategy.obstacle)},
                 {"reason", sentence(strategy, world.scene)}};
    if (strategy.blocker) json["blocked_by"] = *strategy.blocker;
    Json path = Json::array();
    for (const ref::Vertex& vertex : strategy.path) path.push_back(of(world, vertex));
    json["path"] = path;
    if (!strategy.made) return json;
    json["value"] = of(strategy.made->value);
    json["weight"] = strategy.made->weight;
    json["weight_balance"] = strategy.balance;
    json["weight_power"] = strategy.power;
    json["contribution"] = of(strategy.contribution());
    Json formula = Json::array();
    for (const Factor& factor : factors(world, sample, strategy))
        formula.push_back({{"name", factor.name},
                           {"value", of(factor.value)},
                           {"scalar", factor.is_scalar},
                           {"divides", factor.divides}});
    json["factors"] = formula;
    json["pixel"] = of_pixel(strategy.made->pixel, world);
    json["dropped"] = strategy.is_dropped();
    add_densities(json, strategy);
    return json;
}

Json of(const ref::World& world, const std::vector<FastVertex>& walk)
{
    Json vertices = Json::array();
    for (const FastVertex& vertex : walk) {
        Json json = {{"on", describe(world.scene, vertex)}};
        const bool far = vertex.kind == ref::Vertex::Kind::infinity;
        json[far ? "towards" : "position"] = of(far ? vertex.towards : vertex.position);
        if (vertex.kind == ref::Vertex::Kind::surface) {
            json["normal"] = of(vertex.normal);
            json["primitive"] = vertex.primitive;
        }
        json["alpha"] = of(vertex.alpha);
        json["pdf_solid_angle"] = of(vertex.pdf_solid_angle);
        json["pdf_area"] = of(vertex.pdf_area);
        json["probability"] = of(vertex.probability);
        if (vertex.bounce)
            json["bounce"] = {{"delta", vertex.bounce->delta},
                              {"pdf_fwd", vertex.bounce->pdf_fwd},
                              {"pdf_rev", vertex.bounce->pdf_rev},
                              {"survival", vertex.bounce->survival}};
        vertices.push_back(json);
    }
    return {{"vertices", vertices}};
}

Json of(const ref::World& world, const FastSample& fast)
{
    Json strategies = Json::array();
    for (const FastContribution& made : fast.made)
        strategies.push_back({{"s", made.s},
                              {"t", made.t},
                              {"value", of(Vec3(made.value))},
                              {"weight", made.weight},
                              {"contribution", of(Vec3(made.contribution()))},
                              {"pixel", of_pixel(made.pixel, world)},
                              {"dropped", made.is_dropped()}});
    return {{"eye_walk", of(world, fast.eye)},
            {"light_walk", of(world, fast.light)},
            {"strategies", strategies},
            {"own", of(Vec3(fast.own))}};
}

Json of(const ref::World& world, const Sample& sample)
{
    const ref::PathOptions& options = sample.options;
    Json draws = Json::array();
    for (const Draw& draw : sample.draws) draws.push_back(of(draw));
    Json strategies = Json::array();
    for (const Strategy& strategy : sample.strategies) strategies.push_back(of(world, sample, strategy));
    const bool limited = options.max_edges != images::unlimited_edges;
    return {{"scene", world.scene.name},
            {"scene_hash", world.scene.hash},
            {"unit", world.scene.unit},
            {"size", {world.camera.width(), world.camera.height()}},
            {"pixel", of_pixel(sample.id.pixel, world)},
            {"sample", sample.id.sample},
            {"seed", options.seed},
            {"integrator", name_of(sample.integrator)},
            {"heuristic", name_of(options.heuristic)},
            {"max_edges", limited ? Json(options.max_edges) : Json(nullptr)},
            {"roulette", options.roulette},
            {"roulette_from", options.roulette_from},
            {"random_numbers", draws},
            {"eye_walk", of(world, sample.eye)},
            {"light_walk", of(world, sample.light)},
            {"strategies", strategies},
            {"own", of(sample.own)}};
}

std::string text_of(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string json(const ref::World& world, const Sample& sample)
{
    return text_of(of(world, sample));
}

std::string json(const ref::World& world, const Sample& sample, const FastSample& fast)
{
    Json both = of(world, sample);
    both["host"] = of(world, fast);
    return text_of(both);
}

} // namespace explain
