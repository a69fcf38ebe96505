// A sample of bidirectional path tracing or of light tracing: the strategies in the order of
// ref/transport/bdpt.cpp.

#include "explain/parts.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/connect.h"

#include <algorithm>

namespace explain {

namespace {

/// The vertices of a walk.
std::vector<ref::Vertex> vertices_of(const Walk& walk)
{
    std::vector<ref::Vertex> vertices;
    for (const Step& step : walk.steps) vertices.push_back(step.vertex);
    return vertices;
}

/// Sets the densities of the path under all strategies, relative to the one that made it, and its
/// weights.
void add_densities(const Setting& setting, Strategy& strategy)
{
    const auto s = static_cast<std::size_t>(strategy.s);
    ref::Path x;
    for (const ref::Vertex& vertex : strategy.path) x.push_back(&vertex);
    ref::PathOptions options = setting.options;
    strategy.p = vertex_densities(setting.world, options, x);
    const ref::VertexDensities& p = *strategy.p;
    options.heuristic = ref::Heuristic::balance;
    strategy.balance = mis_weight(setting.world, options, x, s);
    options.heuristic = ref::Heuristic::power;
    strategy.power = mis_weight(setting.world, options, x, s);
    // A weight of 0 means that the strategy cannot make the path: nothing is relative to it.
    const std::vector<double> relative = strategy.balance > 0.0
                                             ? density_quotients(setting.world, x, p, s)
                                             : std::vector<double>(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        long double value = is_possible(setting.world, x, i) ? 1.0L : 0.0L;
        for (std::size_t j = 0; j < x.size(); ++j)
            value *= static_cast<long double>(j < i ? p.light[j] : p.eye[j]);
        strategy.densities.push_back({static_cast<int>(i), value, relative[i]});
    }
}

/// The strategies of two walks.
class Joins {
public:
    Joins(const Setting& setting, Sample& sample)
        : setting_(setting), sample_(sample), y_(vertices_of(sample.light)), z_(vertices_of(sample.eye)),
          only_light_(sample.integrator == images::Integrator::light)
    {}

    void add_all()
    {
        // With short paths, the strategies of vertices that the walks do not have are listed as well.
        const bool few = setting_.options.max_edges <= images::most_edges_of_strategies;
        const int edges = few ? setting_.options.max_edges : 0;
        const int most_t = std::max(static_cast<int>(z_.size()), edges + 1);
        const int most_s = std::max({static_cast<int>(y_.size()), edges, 1}); // 1: next events
        if (!only_light_)
            for (int t = 2; t <= most_t; ++t)
                for (int s = 0; s <= most_s; ++s)
                    if (is_listed(s, t)) add(s, t);
        for (int s = 1; s <= most_s; ++s)
            if (is_listed(s, 1)) add(s, 1);
    }

private:
    [[nodiscard]] bool has_vertices(int s, int t) const
    {
        // The y_0 of a next event is not that of the light walk.
        const bool light = s <= static_cast<int>(y_.size()) || (s == 1 && t >= 2);
        return light && t <= static_cast<int>(z_.size());
    }

    [[nodiscard]] bool is_listed(int s, int t) const
    {
        return s + t - 1 <= std::min(setting_.options.max_edges, images::most_edges_of_strategies) ||
               has_vertices(s, t);
    }

    /// Whether an option leaves out the strategy (s, t).
    [[nodiscard]] bool is_left_out(int s, int t) const
    {
        const images::Families& families = setting_.options.families;
        if (t == 1) return !families.light_image && !only_light_;
        return s == 0   ? !families.emission_hit
               : s == 1 ? !families.next_event
                        : !families.inner_connection;
    }

    void add(int s, int t)
    {
        Strategy strategy{s, t};
        if (s + t - 1 > setting_.options.max_edges)
            strategy.obstacle = Obstacle::too_long;
        else if (is_left_out(s, t))
            strategy.obstacle = Obstacle::left_out;
        else if (t > static_cast<int>(z_.size()))
            strategy.obstacle = Obstacle::no_eye_vertex;
        else if (!has_vertices(s, t))
            strategy.obstacle = Obstacle::no_light_vertex;
        else
            join(strategy);
        sample_.strategies.push_back(std::move(strategy));
    }

    void join(Strategy& strategy)
    {
        const std::span z(z_.data(), static_cast<std::size_t>(strategy.t));
        const std::span y(y_.data(),
                          static_cast<std::size_t>(strategy.s == 1 && strategy.t > 1 ? 0 : strategy.s));
        for (const ref::Vertex* vertex : ref::join(y, z)) strategy.path.push_back(*vertex);
        const auto& [world, options, id] = setting_;
        if (strategy.t == 1) {
            strategy.made = light_image(world, options, y, z_[0]);
            if (!strategy.made) find_obstacle_of_light_image(setting_, y, z_[0], strategy);
        } else if (strategy.s == 0) {
            strategy.made = emission_hit(world, options, id, z);
            if (!strategy.made) find_obstacle_of_emission_hit(setting_, strategy);
        } else if (strategy.s == 1) {
            add_light_vertex(z.back(), strategy);
            strategy.made = next_event(world, options, id, z);
            if (!strategy.made) find_obstacle_of_next_event(setting_, z, strategy);
        } else {
            strategy.made = inner_connection(world, options, id, y, z);
            if (!strategy.made) find_obstacle_of_inner_connection(setting_, y, z, strategy);
        }
        if (strategy.made) add_weights(strategy);
    }

    /// The fresh point of an emitter with which the path of a next event begins.
    void add_light_vertex(const ref::Vertex& last, Strategy& strategy)
    {
        if (!scatters(setting_.world, last)) return;
        const Draw draw = draw_of_emitter(setting_, ref::Event::next_event, strategy.t - 1);
        append(sample_.draws, draw);
        const auto light = sample_incident(setting_.world.emitters, last.point.position, draw.uniforms);
        if (light) strategy.path.insert(strategy.path.begin(), light_vertex(setting_.world, *light));
    }

    void add_weights(Strategy& strategy) const
    {
        add_densities(setting_, strategy);
        if (!only_light_) return;
        strategy.made->weight = strategy.balance = strategy.power = 1.0; // there is no other strategy
    }

    const Setting& setting_;
    Sample& sample_;
    std::vector<ref::Vertex> y_;
    std::vector<ref::Vertex> z_;
    bool only_light_;
};

} // namespace

void explain_bidirectional(const Setting& setting, Sample& sample)
{
    const bool only_light = sample.integrator == images::Integrator::light;
    const auto longest = static_cast<std::size_t>(setting.options.max_edges);
    sample.eye = eye_walk(setting, only_light ? 1 : most_eye_vertices(setting.options), sample.draws);
    sample.light =
        light_walk(setting, only_light ? longest : most_light_vertices(setting.options), sample.draws);
    Joins(setting, sample).add_all();
}

} // namespace explain
