// A sample of unidirectional path tracing, edge by edge as in ref/transport/path_tracer.cpp.

#include "explain/parts.h"
#include "ref/transport/connect.h"
#include "ref/transport/path_tracer.h"

namespace explain {

namespace {

/// The densities of the last edge under both strategies, per solid angle at z_{j-1} or z_j; 0 for one
/// that cannot make the path.
void add_weights(Strategy& strategy, double pdf_emission_hit, double pdf_next_event)
{
    const std::array<double, 2> p = {pdf_emission_hit, pdf_next_event};
    const double made = p[static_cast<std::size_t>(strategy.s)];
    double squares = 0.0;
    for (int s = 0; s < 2; ++s) {
        const double of_s = p[static_cast<std::size_t>(s)];
        const double relative = s == strategy.s ? 1.0 : of_s / made;
        strategy.densities.push_back({s, static_cast<long double>(of_s), relative});
        squares += relative * relative;
    }
    strategy.balance = strategy.made->weight;
    strategy.power = 1.0 / squares;
}

/// The walk of the path tracer, and what it adds on its way.
class PathWalk {
public:
    PathWalk(const Setting& setting, Sample& sample)
        : setting_(setting), sample_(sample), z_{eye_vertex(setting.world)}
    {
        sample.eye.steps.push_back({z_[0], std::nullopt, std::nullopt, 1.0});
    }

    /// Why the walk ends.
    WalkEnd follow()
    {
        const auto& [world, options, id] = setting_;
        const images::Families& families = options.families;
        ref::EyeWalk walk = first_edge(world, id);
        for (int j = 1; j <= last_edge(options); ++j) {
            if (j == 1) append(sample_.draws, draw_of_camera(id));
            const auto hit = intersect(world.geometry, walk.ray);
            if (!hit) {
                if (!world.scene.environment) return WalkEnd::left_scene;
                add_vertex(walk, infinity_vertex(*world.emitters.environment(), walk.ray.direction,
                                                 walk.throughput));
                add_emission(j, walk, nullptr);
                return WalkEnd::environment;
            }
            const ref::SurfacePoint point = surface_point(world.geometry, walk.ray, *hit);
            add_vertex(walk, surface_vertex(world, point, walk.throughput));
            add_emission(j, walk, &point);
            if (j == options.max_edges) break;

            const ref::WalkVertex vertex(world, walk, point);
            if (families.next_event)
                add_next_event(j, walk, vertex);
            else
                sample_.strategies.push_back({1, j + 1, Obstacle::left_out});
            const Bounce bounce =
                bounce_at(setting_, ref::Transport::radiance, z_.back(), -walk.ray.direction, j);
            sample_.eye.steps.back().bounce = bounce;
            append(sample_.draws, draw_of_bounce(setting_, ref::Transport::radiance, z_.back(), j));
            const auto next = next_edge(options, id, j, walk, vertex);
            if (!next) return bounce.sample.value == Rgb(0.0) ? WalkEnd::absorbed : WalkEnd::roulette;
            walk = *next;
        }
        return WalkEnd::longest_path;
    }

private:
    /// The path with the last t vertices of the eye walk, backwards.
    [[nodiscard]] std::vector<ref::Vertex> backwards() const { return {z_.rbegin(), z_.rend()}; }

    void add_vertex(const ref::EyeWalk& walk, const ref::Vertex& vertex)
    {
        const bool first = z_.size() == 1;
        const double pdf =
            first ? setting_.world.camera.pdf_solid_angle(direction(z_[0], vertex)) : walk.pdf;
        sample_.eye.steps.push_back(step_to(z_.back(), vertex, pdf, !first && walk.delta));
        z_.push_back(vertex);
    }

    /// s = 0 at the end of edge j: `point`, or the environment.
    void add_emission(int j, const ref::EyeWalk& walk, const ref::SurfacePoint* point)
    {
        const auto& [world, options, id] = setting_;
        Strategy strategy{0, j + 1};
        strategy.path = backwards();
        if (!options.families.emission_hit)
            strategy.obstacle = Obstacle::left_out;
        else if (point == nullptr)
            strategy.made = environment_of_edge(world, id, j, walk);
        else
            strategy.made = emission_of_edge(world, id, j, walk, *point);
        if (strategy.made)
            add_weights(strategy, j == 1 ? *sample_.eye.steps[1].pdf_solid_angle : walk.pdf,
                        walk.delta ? 0.0 : pdf_of_next_event(world, walk, point));
        else if (strategy.obstacle == Obstacle::none)
            find_obstacle_of_emission_hit(setting_, strategy);
        sample_.strategies.push_back(std::move(strategy));
    }

    void add_next_event(int j, const ref::EyeWalk& walk, const ref::WalkVertex& vertex)
    {
        const auto& [world, options, id] = setting_;
        Strategy strategy{1, j + 1};
        strategy.path = backwards();
        const Draw draw = draw_of_emitter(setting_, ref::Event::next_event, j);
        const bool joins = !ref::is_delta(vertex.material);
        if (joins) append(sample_.draws, draw);
        const auto light = sample_incident(world.emitters, vertex.point.position, draw.uniforms);
        if (joins && light) strategy.path.insert(strategy.path.begin(), light_vertex(world, *light));
        strategy.made = next_event_of_vertex(world, options, id, j, walk, vertex);
        if (strategy.made)
            add_weights(
                strategy,
                light->delta ? 0.0 : pdf_of_bounce(options, j, vertex, vertex.frame.to_local(light->wi)),
                light->pdf);
        else
            find_obstacle_of_next_event(setting_, z_, strategy);
        sample_.strategies.push_back(std::move(strategy));
    }

    const Setting& setting_;
    Sample& sample_;
    std::vector<ref::Vertex> z_;
};

} // namespace

void explain_path(const Setting& setting, Sample& sample)
{
    sample.light.end = WalkEnd::not_walked;
    sample.eye.end = PathWalk(setting, sample).follow();
}

} // namespace explain
