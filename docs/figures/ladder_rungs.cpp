#include "docs/figures/ladder_rungs.h"

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"

namespace figures {

void trace_emission(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                    std::vector<ref::Contribution>& out)
{
    ref::PathOptions alone = options;
    alone.families = {true, false, false, false};
    const std::size_t first = out.size();
    ref::trace_path(world, alone, id, out);
    for (std::size_t i = first; i < out.size(); ++i) out[i].weight = 1.0;
}

void trace_next_event(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                      std::vector<ref::Contribution>& out)
{
    const std::size_t first = out.size();
    ref::trace_path(world, options, id, out);
    for (std::size_t i = first; i < out.size(); ++i) {
        // The path tracer gives an emission hit the weight 1 exactly if next event has density 0 there.
        const bool counts = out[i].s == 1 || out[i].weight == 1.0;
        out[i].weight = counts ? 1.0 : 0.0;
    }
}

const std::array<Rung, 5>& ladder()
{
    static constexpr std::array<Rung, 5> rungs = {
        Rung{"emission", "emission only", trace_emission},
        Rung{"next_event", "next event", trace_next_event}, Rung{"path", "both by MIS", ref::trace_path},
        Rung{"light", "light tracing", ref::trace_light},
        Rung{"bdpt", "bidirectional", ref::trace_bidirectionally}};
    return rungs;
}

} // namespace figures
