#include "check/mistakes/finished_path.h"

#include "ref/transport/connect.h"
#include "ref/transport/subpath.h"

#include <numeric>
#include <optional>
#include <span>

namespace check {

namespace {

using ref::Path;
using ref::Vertex;

/// x_0 ... x_k: the light walk, then the eye walk backwards.
Path joined(std::span<const Vertex> y, std::span<const Vertex> z)
{
    Path x;
    for (const Vertex& vertex : y) x.push_back(&vertex);
    for (std::size_t t = z.size(); t > 0; --t) x.push_back(&z[t - 1]);
    return x;
}

/// The point of an emitter to which ref::next_event joins the last vertex of `z`: it draws the same
/// numbers.
std::optional<Vertex> next_event_vertex(const ref::World& world, const ref::SampleId& id,
                                        std::span<const Vertex> z)
{
    const auto light = ref::sample_incident(
        world.emitters, z.back().point.position,
        ref::uniforms(id, ref::Event::next_event, static_cast<std::uint32_t>(z.size() - 1)));
    if (!light) return std::nullopt;
    const ref::Rgb no_walk(1.0);
    if (light->infinite) return ref::infinity_vertex(*light->emitter, light->wi, no_walk);
    if (light->delta) return ref::source_vertex(*light->emitter, light->end.position, no_walk);
    return ref::surface_vertex(world, light->end, no_walk);
}

} // namespace

FinishedPath finished(const ref::World& world, const ref::PathOptions& options, const ref::Path& x,
                      std::size_t s)
{
    FinishedPath path{world, x, {}, {}, {}};
    for (std::size_t i = 0; i < x.size(); ++i) path.possible.push_back(ref::is_possible(world, x, i));
    path.density = ref::density_quotients(world, x, ref::vertex_densities(world, options, x), s);
    const double sum = std::accumulate(path.density.begin(), path.density.end(), 0.0);
    for (const double density : path.density) path.share_of.push_back(density / sum);
    return path;
}

void for_each_path(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                   const UsePath& use)
{
    const auto longest = static_cast<std::size_t>(options.max_edges);
    const std::vector<Vertex> z = ref::eye_subpath(world, options, id, longest + 1);
    const std::vector<Vertex> y = ref::light_subpath(world, options, id, longest);
    const auto add = [&](const std::optional<ref::Contribution>& made, std::span<const Vertex> light,
                         std::span<const Vertex> eye) {
        if (!made || !(made->weight > 0.0)) return;
        const Path x = joined(light, eye);
        const FinishedPath path = finished(world, options, x, light.size());
        use(path, made->pixel, made->weight * made->value);
    };
    for (std::size_t t = 2; t <= z.size(); ++t) {
        const std::span eye(z.data(), t);
        add(ref::emission_hit(world, options, id, eye), {}, eye);
        if (t <= longest)
            if (const auto made = ref::next_event(world, options, id, eye)) {
                const auto y0 = next_event_vertex(world, id, eye);
                add(made, {&*y0, 1}, eye);
            }
        for (std::size_t s = 2; s <= y.size() && s + t - 1 <= longest; ++s)
            add(ref::inner_connection(world, options, id, {y.data(), s}, eye), {y.data(), s}, eye);
    }
    for (std::size_t s = 1; s <= y.size(); ++s)
        add(ref::light_image(world, options, {y.data(), s}, z[0]), {y.data(), s}, {z.data(), 1});
}

} // namespace check
