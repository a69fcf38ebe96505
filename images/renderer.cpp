#include "images/renderer.h"

#include <stdexcept>

namespace images {

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

bool fill(Film& film, std::uint64_t batches, Renderer& renderer, const Monitor& monitor,
          const std::function<void(const Batch&)>& added)
{
    return render_batches(renderer, film.batches(), batches, monitor, [&](const Batch& batch) {
        film.add_batch(batch.mean);
        if (added) added(batch);
    });
}

} // namespace images
