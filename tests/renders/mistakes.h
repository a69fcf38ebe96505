#pragma once

// Wrong bidirectional path tracers, with defects that real renderers have had.

#include "ref/transport/bdpt.h"

#include <vector>

namespace renders_test {

using ref::Contribution;

/// Bidirectional path tracing, each of its contributions altered.
template <void (*alter)(Contribution&)>
void altered(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
             std::vector<Contribution>& out)
{
    const std::size_t first = out.size();
    ref::trace_bidirectionally(world, options, id, out);
    for (std::size_t i = first; i < out.size(); ++i) alter(out[i]);
}

inline void change_nothing(Contribution& /*c*/) {}

inline void dim_by_a_thousandth(Contribution& c)
{
    c.value *= 0.999;
}

inline void dim_one_pixel(Contribution& c)
{
    if (c.pixel == 0) c.value *= 0.9;
}

/// A factor of the camera that is off by one percent.
inline void dim_by_one_percent(Contribution& c)
{
    c.value *= 0.99;
}

inline void dim_by_two_percent(Contribution& c)
{
    c.value *= 0.98;
}

/// The weights of a course report: the same for all strategies of a length, possible or not.
inline void weigh_uniformly(Contribution& c)
{
    c.weight = 1.0 / (c.s + c.t);
}

/// The light image of a crop without the factor for its share of the film.
inline void scale_splats(Contribution& c)
{
    if (c.t == 1) c.value *= 0.5;
}

inline void drop_next_event(Contribution& c)
{
    if (c.s == 1 && c.t == 2) c.weight = 0.0;
}

inline void drop_inner_connection(Contribution& c)
{
    if (c.s == 2 && c.t == 2) c.weight = 0.0;
}

/// Splats land one pixel to the left: a projection that rounds wrongly.
inline void misplace_splats(Contribution& c)
{
    if (c.t == 1 && c.pixel > 0) --c.pixel;
}

} // namespace renders_test
