#include "cli/renderer_for.h"

#include "cli/builders.h"
#include "cli/scene_input.h"
#include "cuda/launch/renderer.h"
#include "cuda/scene/float_notices.h"
#include "ref/transport/renderer.h"

#include <iostream>
#include <stdexcept>
#include <string>

namespace cli {

namespace {

/// Throws std::invalid_argument if this processor does not have them.
fast::InstructionSet instructions_named(const std::string& name)
{
    if (name == "best") return fast::best_instruction_set();
    for (const fast::InstructionSet set : fast::instruction_sets())
        if (name_of(set) == name) return set;
    throw std::invalid_argument("--instructions " + name + ": this processor does not have them, or " +
                                "the program was built without; the best is " +
                                std::string(name_of(fast::best_instruction_set())));
}

/// --epsilon at the scale of `scene`; 0 if it was not given.
double epsilon_in(const scenes::Scene& scene, const RenderCommand& options)
{
    if (!options.epsilon) return 0.0;
    const double epsilon = *options.epsilon * scene.unit;
    if (!(epsilon > 0.0 && epsilon <= 1e100))
        throw std::invalid_argument("--epsilon: out of range for a scene of this size");
    return epsilon;
}

} // namespace

std::unique_ptr<images::Renderer> renderer_for(const RenderCommand& options, const scenes::Scene& scene)
{
    const Size size = parse_size(options.size);
    const images::RenderOptions plan = render_options(options);
    if (options.device == "ref")
        return ref::renderer(scene, size.width, size.height, plan, options.threads,
                             {builder_named(options.builder), options.leaf_size},
                             epsilon_in(scene, options));
    if (!options.quiet)
        for (const std::string& notice : fast::float_notices(scene))
            std::cerr << shown_name(options.scene) << ": " << notice << '\n';
    if (options.device == "host")
        return fast::host_renderer(scene, size.width, size.height, plan, options.threads,
                                   instructions_named(options.instructions));
    try {
        return fast::device_renderer(scene, size.width, size.height, plan,
                                     options.kernels == "stages" ? fast::DeviceKernels::stages
                                                                 : fast::DeviceKernels::samples);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(std::string("--device cuda: ") + error.what());
    }
}

std::optional<fast::Needs> kernel_of(const images::Renderer& renderer)
{
    const auto* fast = dynamic_cast<const fast::Renderer*>(&renderer);
    return fast == nullptr ? std::nullopt : std::optional(fast->needs());
}

} // namespace cli
