#include "cli/fast_render.h"

#include "cli/scene_input.h"
#include "cuda/transport/float_notices.h"
#include "cuda/transport/renderer.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <stdexcept>

namespace cli {

namespace {

const std::map<std::string, gpu::Integrator> fast_integrators = {
    {"path", gpu::Integrator::path}, {"bdpt", gpu::Integrator::bdpt}, {"light", gpu::Integrator::light}};

} // namespace

void LayerSums::add(const images::Strategies& batch, std::uint32_t samples)
{
    for (const auto& [strategy, image] : batch) {
        images::Image& sum = sums_.try_emplace(strategy, image.width, image.height).first->second;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    }
    samples_ += samples;
}

images::Strategies LayerSums::means() const
{
    images::Strategies result;
    for (const auto& [strategy, sum] : sums_) {
        const bool dark =
            std::ranges::all_of(sum.pixels, [](const auto& p) { return p == images::Rgb(0.0); });
        if (dark) continue;
        images::Image& mean = result.emplace(strategy, sum).first->second;
        for (auto& pixel : mean.pixels) pixel /= static_cast<double>(samples_);
    }
    return result;
}

std::unique_ptr<gpu::Renderer> fast_renderer(const RenderCommand& options, const scenes::Scene& scene)
{
    const Size size = parse_size(options.size);
    gpu::RenderOptions plan;
    plan.integrator = fast_integrators.at(options.integrator);
    plan.heuristic = options.heuristic == "power" ? gpu::Heuristic::power : gpu::Heuristic::balance;
    plan.seed = options.seed;
    plan.max_edges = std::min(options.max_edges, gpu::most_edges);
    plan.roulette = !options.no_roulette;
    plan.batch_size = options.batch_size;
    plan.deterministic = options.deterministic;
    if (wants_layers(options))
        plan.layers = options.unweighted ? gpu::Layers::unweighted : gpu::Layers::weighted;
    if (!options.quiet)
        for (const std::string& notice : gpu::float_notices(scene))
            std::cerr << shown_name(options.scene) << ": " << notice << '\n';
    if (options.device == "host")
        return gpu::host_renderer(scene, size.width, size.height, plan, options.threads);
    try {
        return gpu::device_renderer(scene, size.width, size.height, plan);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(std::string("--device cuda: ") + error.what());
    }
}

std::optional<images::Image> render_batch(gpu::Renderer& renderer, const RenderCommand& options,
                                          std::uint64_t number, const ref::Monitor& monitor,
                                          LayerSums* layers)
{
    const gpu::Monitor inner{[&](double part) {
                                 if (monitor.progress)
                                     monitor.progress(static_cast<double>(number) + part);
                             },
                             monitor.stop};
    std::optional<gpu::Batch> batch = renderer.render_batch(number, inner);
    if (!batch) return std::nullopt;
    if (layers != nullptr) layers->add(batch->layers, options.batch_size);
    if (batch->dropped.count > 0) {
        if (!monitor.dropped)
            throw std::runtime_error(images::describe(batch->dropped, batch->mean.width));
        monitor.dropped(batch->dropped);
    }
    return std::move(batch->mean);
}

bool render(gpu::Renderer& renderer, const RenderCommand& options, images::Film& film,
            const ref::Monitor& monitor, LayerSums& layers)
{
    while (film.batches() < options.samples / options.batch_size) {
        const auto batch = render_batch(renderer, options, film.batches(), monitor, &layers);
        if (!batch) return false;
        film.add_batch(*batch);
        if (monitor.batch) monitor.batch(*batch);
        if (monitor.kept) monitor.kept(film);
    }
    return true;
}

} // namespace cli
