#include "explain/sample.h"

#include "explain/parts.h"
#include "ref/trees/aabb.h"

#include <cmath>

namespace explain {

bool Strategy::is_dropped() const
{
    return made && (!ref::is_finite(made->value) || !std::isfinite(made->weight));
}

Sample explain_sample(const ref::World& world, images::Integrator integrator,
                      const ref::PathOptions& options, const ref::SampleId& id)
{
    Sample sample{id, integrator, options, {}, {{}, WalkEnd::not_walked}, {{}, WalkEnd::not_walked}, {}};
    const Setting setting{world, sample.options, sample.id};
    if (integrator == images::Integrator::path)
        explain_path(setting, sample);
    else
        explain_bidirectional(setting, sample);
    for (const Strategy& strategy : sample.strategies)
        if (strategy.made && strategy.t > 1 && !strategy.is_dropped())
            sample.own += strategy.made->weight * strategy.made->value;
    return sample;
}

} // namespace explain
