#include "ref/transport/bdpt.h"

#include "ref/transport/connect.h"
#include "ref/transport/subpath.h"

namespace ref {

namespace {

void add(const std::optional<Contribution>& contribution, std::vector<Contribution>& out)
{
    if (contribution) out.push_back(*contribution);
}

/// The most vertices that a walk can need. A path has s + t - 1 edges, at most max_edges. So a light
/// walk needs at most max_edges vertices, and an eye walk one more.
std::size_t most_vertices(const PathOptions& options)
{
    return static_cast<std::size_t>(options.max_edges);
}

} // namespace

void trace_bidirectionally(const World& world, const PathOptions& options, const SampleId& id,
                           std::vector<Contribution>& out)
{
    const std::size_t longest = most_vertices(options);
    const std::vector<Vertex> z = eye_subpath(world, options, id, longest + 1);
    const std::vector<Vertex> y = light_subpath(world, options, id, longest);

    for (std::size_t t = 2; t <= z.size(); ++t) {
        const std::span eye_walk(z.data(), t);
        add(emission_hit(world, options, id, eye_walk), out);
        if (t <= longest) add(next_event(world, options, id, eye_walk), out);
        for (std::size_t s = 2; s <= y.size() && s + t - 1 <= longest; ++s)
            add(inner_connection(world, options, id, {y.data(), s}, eye_walk), out);
    }
    for (std::size_t s = 1; s <= y.size(); ++s)
        add(light_image(world, options, {y.data(), s}, z[0]), out);
}

void trace_light(const World& world, const PathOptions& options, const SampleId& id,
                 std::vector<Contribution>& out)
{
    const Vertex eye = eye_vertex(world);
    const std::vector<Vertex> y = light_subpath(world, options, id, most_vertices(options));
    const std::size_t first = out.size();
    for (std::size_t s = 1; s <= y.size(); ++s)
        add(light_image(world, options, {y.data(), s}, eye), out);
    for (std::size_t i = first; i < out.size(); ++i) out[i].weight = 1.0;
}

} // namespace ref
