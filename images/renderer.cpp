#include "images/renderer.h"

#include "images/families.h"

#include <stdexcept>
#include <string>

namespace images {

void check(const RenderOptions& options)
{
    if (options.max_edges < 1) throw std::invalid_argument("a path has at least one edge");
    if (options.roulette_from < 1)
        throw std::invalid_argument("roulette begins with the first bounce or a later one");
    if (options.strategies != StrategyPictures::none && options.max_edges > most_edges_of_strategies)
        throw std::invalid_argument("a picture for each strategy needs paths of at most " +
                                    std::to_string(most_edges_of_strategies) + " edges");
    expect_families(options.integrator, options.families);
}

std::optional<Batch> Renderer::render_batch(std::uint64_t number, const Monitor& monitor)
{
    std::optional<Batch> batch = make_batch(number, monitor);
    if (!batch || batch->dropped.count == 0) return batch;
    if (!monitor.dropped) throw std::runtime_error(describe(batch->dropped, batch->mean.width));
    monitor.dropped(batch->dropped);
    return batch;
}

bool render_batches(Renderer& renderer, std::uint64_t first, std::uint64_t end, const Monitor& monitor,
                    const std::function<void(const Batch&)>& done)
{
    for (std::uint64_t number = first; number < end; ++number) {
        const std::optional<Batch> batch = renderer.render_batch(number, monitor);
        if (!batch) return false;
        done(*batch);
    }
    return true;
}

bool fill(Film& film, std::uint64_t end, Renderer& renderer, const Monitor& monitor,
          const std::function<void(const Batch&)>& added)
{
    return render_batches(renderer, film.range().end, end, monitor, [&](const Batch& batch) {
        film.add_batch(batch.mean);
        if (added) added(batch);
    });
}

} // namespace images
