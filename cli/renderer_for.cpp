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

/// Throws std::invalid_argument if this program or this processor does not have them.
fast::InstructionSet instructions_named(const std::string& name)
{
    if (name == "best") return fast::best_instruction_set();
    if (name == name_of(fast::InstructionSet::fastmath)) {
        if (fast::has_fast_math()) return fast::InstructionSet::fastmath;
        throw std::invalid_argument("--instructions fastmath: the program was built without it " +
                                    std::string("(PLUMBLINE_FAST_MATH_KERNELS in CMake), or this "
                                                "processor lacks its instructions"));
    }
    for (const fast::InstructionSet set : fast::instruction_sets())
        if (name_of(set) == name) return set;
    throw std::invalid_argument("--instructions " + name + ": this processor does not have them, or " +
                                "the program was built without; the best is " +
                                std::string(name_of(fast::best_instruction_set())));
}

std::string reference_builder(const RenderCommand& options)
{
    return options.builder.empty() ? default_builder : options.builder;
}

/// The needs that `--kernel-needs` adds to those of the scene.
fast::Needs needs_named(const std::string& name)
{
    if (name == "all") return fast::any_needs;
    return name == "specular" ? fast::Needs{true, true, false} : fast::Needs{};
}

fast::RendererOptions choices_of(const RenderCommand& options)
{
    fast::RendererOptions choices;
    if (options.device == "host") choices.instructions = instructions_named(options.instructions);
    if (options.kernels == "stages") choices.kernels = fast::DeviceKernels::stages;
    choices.at_least = needs_named(options.kernel_needs);
    choices.tree = fast_builder_named(options.builder);
    return choices;
}

} // namespace

std::unique_ptr<images::Renderer> renderer_for(const RenderCommand& options, const scenes::Scene& scene)
{
    const Size size = parse_size(options.size);
    const images::RenderOptions plan = render_options(options);
    if (options.device == "ref")
        return ref::renderer(scene, size.width, size.height, plan, options.threads,
                             {builder_named(reference_builder(options)), options.leaf_size});
    if (!options.quiet)
        for (const std::string& notice : fast::float_notices(scene))
            std::cerr << shown_name(options.scene) << ": " << notice << '\n';
    const fast::RendererOptions choices = choices_of(options);
    if (options.device == "host")
        return fast::host_renderer(scene, size.width, size.height, plan, options.threads, choices);
    try {
        return fast::device_renderer(scene, size.width, size.height, plan, choices);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(std::string("--device cuda: ") + error.what());
    }
}

std::optional<fast::Needs> kernel_of(const images::Renderer& renderer)
{
    const auto* fast = dynamic_cast<const fast::Renderer*>(&renderer);
    return fast == nullptr ? std::nullopt : std::optional(fast->needs());
}

std::string builder_of(const RenderCommand& options, const images::Renderer& renderer)
{
    const auto* fast = dynamic_cast<const fast::Renderer*>(&renderer);
    return fast == nullptr ? reference_builder(options) : std::string(name_of(fast->tree()));
}

} // namespace cli
