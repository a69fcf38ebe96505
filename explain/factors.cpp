#include "explain/factors.h"

#include "explain/parts.h"

namespace explain {

namespace {

/// The names of the vertices at the ends.
struct Ends {
    std::string y, z;

    explicit Ends(const Strategy& strategy)
        : y("y_" + std::to_string(strategy.s - 1)), z("z_" + std::to_string(strategy.t - 1))
    {}
};

Factor scalar(const std::string& name, double value, bool divides = false)
{
    return {name, Rgb(value), true, divides};
}

std::vector<Factor> of_next_event(const ref::World& world, const Sample& sample,
                                  const Strategy& strategy)
{
    const Ends ends(strategy);
    const ref::Vertex& y0 = strategy.path[0];
    const ref::Vertex& z = strategy.path[1];
    const ref::Uniforms u =
        uniforms(sample.id, ref::Event::next_event, static_cast<std::uint32_t>(strategy.t - 1));
    const auto light = sample_incident(world.emitters, z.point.position, u);
    return {{"alpha of " + ends.z, z.alpha},
            {"f at " + ends.z, evaluate_bsdf(world, y0, z, strategy.path[2])},
            scalar("cos at " + ends.z, cosine(z, light->wi)),
            {light->delta ? "irradiance from y_0" : "L from y_0", light->radiance},
            scalar(light->delta ? "probability of the emitter" : "pdf_solid_angle of y_0", light->pdf,
                   true)};
}

std::vector<Factor> of_light_image(const ref::World& world, const Strategy& strategy)
{
    const Ends ends(strategy);
    const auto s = static_cast<std::size_t>(strategy.s);
    const ref::Vertex& y = strategy.path[s - 1];
    const ref::Vertex& eye = strategy.path[s];
    const Vec3 w = direction(eye, y);
    return {{"alpha of " + ends.y, y.alpha},
            s == 1 ? Factor{"L at y_0", emitted(world, y, eye)}
                   : Factor{"f at " + ends.y, evaluate_bsdf(world, strategy.path[s - 2], y, eye)},
            scalar("G of " + ends.y + " and z_0", geometric_term(y, eye)),
            scalar("cos at z_0", world.camera.cosine(w)),
            scalar("W_e", world.camera.importance(w))};
}

std::vector<Factor> of_inner_connection(const ref::World& world, const Strategy& strategy)
{
    const Ends ends(strategy);
    const auto s = static_cast<std::size_t>(strategy.s);
    const std::vector<ref::Vertex>& x = strategy.path;
    return {{"alpha of " + ends.y, x[s - 1].alpha},
            {"f at " + ends.y, evaluate_bsdf(world, x[s - 2], x[s - 1], x[s])},
            {"f at " + ends.z, evaluate_bsdf(world, x[s - 1], x[s], x[s + 1])},
            scalar("G of " + ends.y + " and " + ends.z, geometric_term(x[s - 1], x[s])),
            {"alpha of " + ends.z, x[s].alpha}};
}

} // namespace

std::vector<Factor> factors(const ref::World& world, const Sample& sample, const Strategy& strategy)
{
    if (!strategy.made) return {};
    if (strategy.t == 1) return of_light_image(world, strategy);
    if (strategy.s == 1) return of_next_event(world, sample, strategy);
    if (strategy.s > 1) return of_inner_connection(world, strategy);
    const Ends ends(strategy);
    return {{"alpha of " + ends.z, strategy.path[0].alpha},
            {"L at " + ends.z, emitted(world, strategy.path[0], strategy.path[1])}};
}

} // namespace explain
