#include "ref/transport/renderer.h"

#include "ref/transport/batch.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"

#include <stdexcept>

namespace ref {

namespace {

class RefRenderer : public images::Renderer {
public:
    RefRenderer(const World& world, Integrator integrator, const images::RenderOptions& options,
                unsigned threads)
        : world_(world), integrator_(integrator), options_(options), threads_(threads)
    {
        images::check(options);
    }

private:
    std::optional<images::Batch> make_batch(std::uint64_t number,
                                            const images::Monitor& monitor) override
    {
        return sample_batch(world_, integrator_, options_, number, threads_, monitor);
    }

    const World& world_;
    Integrator integrator_;
    images::RenderOptions options_;
    unsigned threads_;
};

/// World is the first base, because the renderer refers to it.
class SceneRenderer : private World, public RefRenderer {
public:
    SceneRenderer(const scenes::Scene& source, int width, int height,
                  const images::RenderOptions& options, unsigned threads, const BuildOptions& tree)
        : World(source, width, height, tree),
          RefRenderer(static_cast<const World&>(*this), integrator_of(options.integrator), options,
                      threads)
    {}
};

} // namespace

Integrator integrator_of(images::Integrator name)
{
    switch (name) {
    case images::Integrator::path:
        return trace_path;
    case images::Integrator::bdpt:
        return trace_bidirectionally;
    case images::Integrator::light:
        return trace_light;
    }
    throw std::invalid_argument("unknown integrator");
}

std::unique_ptr<images::Renderer> renderer(const World& world, Integrator integrator,
                                           const images::RenderOptions& options, unsigned threads)
{
    return std::make_unique<RefRenderer>(world, integrator, options, threads);
}

std::unique_ptr<images::Renderer> renderer(const scenes::Scene& scene, int width, int height,
                                           const images::RenderOptions& options, unsigned threads,
                                           const BuildOptions& tree)
{
    return std::make_unique<SceneRenderer>(scene, width, height, options, threads, tree);
}

} // namespace ref
