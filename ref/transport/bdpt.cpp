#include "ref/transport/bdpt.h"

#include "ref/transport/connect.h"
#include "ref/transport/subpath.h"

namespace ref {

namespace {

void add(const std::optional<Contribution>& contribution, std::vector<Contribution>& out)
{
    if (contribution) out.push_back(*contribution);
}

/// The most edges of a path.
std::size_t most_edges(const PathOptions& options)
{
    return static_cast<std::size_t>(options.max_edges);
}

} // namespace

std::size_t most_eye_vertices(const PathOptions& options)
{
    const std::size_t longest = most_edges(options);
    if (options.families.emission_hit) return longest + 1;
    if (options.families.next_event) return longest;
    return options.families.inner_connection ? longest - 1 : 1;
}

std::size_t most_light_vertices(const PathOptions& options)
{
    const std::size_t longest = most_edges(options);
    if (options.families.light_image) return longest;
    return options.families.inner_connection ? longest - 1 : 0;
}

void trace_bidirectionally(const World& world, const PathOptions& options, const SampleId& id,
                           std::vector<Contribution>& out)
{
    const std::size_t longest = most_edges(options);
    const images::Families& families = options.families;
    const std::vector<Vertex> z = eye_subpath(world, options, id, most_eye_vertices(options));
    const std::vector<Vertex> y = light_subpath(world, options, id, most_light_vertices(options));

    for (std::size_t t = 2; t <= z.size(); ++t) {
        const std::span eye_walk(z.data(), t);
        if (families.emission_hit) add(emission_hit(world, options, id, eye_walk), out);
        if (families.next_event && t <= longest) add(next_event(world, options, id, eye_walk), out);
        if (!families.inner_connection) continue;
        for (std::size_t s = 2; s <= y.size() && s + t - 1 <= longest; ++s)
            add(inner_connection(world, options, id, {y.data(), s}, eye_walk), out);
    }
    if (!families.light_image) return;
    for (std::size_t s = 1; s <= y.size(); ++s)
        add(light_image(world, options, {y.data(), s}, z[0]), out);
}

void trace_light(const World& world, const PathOptions& options, const SampleId& id,
                 std::vector<Contribution>& out)
{
    const Vertex eye = eye_vertex(world);
    const std::vector<Vertex> y = light_subpath(world, options, id, most_edges(options));
    const std::size_t first = out.size();
    for (std::size_t s = 1; s <= y.size(); ++s)
        add(light_image(world, options, {y.data(), s}, eye), out);
    for (std::size_t i = first; i < out.size(); ++i) out[i].weight = 1.0;
}

} // namespace ref
