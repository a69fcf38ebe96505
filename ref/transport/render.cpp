#include "ref/transport/render.h"

#include "ref/trees/aabb.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ref {

namespace {

constexpr int tile_size = 16;

struct Tile {
    int x0, y0, x1, y1; // the pixels x0 <= x < x1, y0 <= y < y1
};

std::vector<Tile> tiles_of(int width, int height)
{
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size)
            tiles.push_back({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
    return tiles;
}

/// One batch in the making. Sums are formed in an order of their own, not in that of the threads: a
/// pixel's own samples one after the other; apart from them what light walks splat on it, tile by tile;
/// then both together. Splats of a tile that is done before its turn wait, the others are summed at
/// once: a picture's worth of them would not fit in memory.
class Batch {
public:
    Batch(const World& world, Integrator integrator, const RenderOptions& options, std::uint64_t number,
          StrategyLayers* layers)
        : world_(world), integrator_(integrator), options_(options), number_(number),
          tiles_(tiles_of(world.camera.width(), world.camera.height())),
          sum_(world.camera.width(), world.camera.height()), waiting_(tiles_.size()),
          splat_sum_(world.camera.width(), world.camera.height())
    {
        if (layers != nullptr) layers_ = layers->empty_copy();
    }

    /// Whether it was finished: `monitor` may stop it.
    bool run(const Monitor& monitor)
    {
        {
            std::vector<std::jthread> helpers;
            for (unsigned i = 1; i < options_.threads; ++i) helpers.emplace_back([&] { work(monitor); });
            work(monitor);
        }
        if (error_) std::rethrow_exception(error_);
        if (stopped_) return false;
        if (dropped_.count > 0) {
            if (!monitor.dropped)
                throw std::runtime_error(images::describe(dropped_, world_.camera.width()));
            monitor.dropped(dropped_);
        }
        for (std::size_t i = 0; i < sum_.pixels.size(); ++i)
            sum_.pixels[i] =
                (sum_.pixels[i] + splat_sum_.pixels[i]) / static_cast<double>(options_.batch_size);
        return true;
    }

    /// The mean per pixel.
    [[nodiscard]] const images::Image& mean() const { return sum_; }
    [[nodiscard]] const std::optional<StrategyLayers>& layers() const { return layers_; }

private:
    void work(const Monitor& monitor)
    {
        try {
            for (std::size_t tile = next_tile_++; tile < tiles_.size() && !stopped_;
                 tile = next_tile_++) {
                if (monitor.stop && monitor.stop()) {
                    stopped_ = true;
                    break;
                }
                images::Dropped dropped;
                std::vector<Contribution> splats = sample_tile(tiles_[tile], dropped);
                const std::scoped_lock lock(mutex_);
                dropped_ += dropped;
                waiting_[tile] = std::move(splats);
                add_splats_in_order();
                ++tiles_done_;
                if (monitor.progress)
                    monitor.progress(static_cast<double>(number_) +
                                     static_cast<double>(tiles_done_) /
                                         static_cast<double>(tiles_.size()));
            }
        } catch (...) {
            const std::scoped_lock lock(mutex_);
            error_ = std::current_exception();
            stopped_ = true;
        }
    }

    /// Adds what the tile's samples show on their own pixels, and returns what they splat on any pixel:
    /// the light image, t = 1. No other thread touches the tile's pixels, nor its layers of t > 1 there.
    /// What is not finite goes to `dropped`.
    std::vector<Contribution> sample_tile(const Tile& tile, images::Dropped& dropped)
    {
        std::vector<Contribution> contributions;
        std::vector<Contribution> splats;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * world_.camera.width() + x);
                for (std::uint32_t i = 0; i < options_.batch_size; ++i) {
                    const auto sample = static_cast<std::uint32_t>(number_ * options_.batch_size + i);
                    contributions.clear();
                    integrator_(world_, options_.path, {options_.path.seed, pixel, sample},
                                contributions);
                    for (const Contribution& c : contributions) {
                        if (!is_finite(c.value) || !std::isfinite(c.weight))
                            dropped += {1, c.pixel, c.s, c.t};
                        else if (c.t == 1)
                            splats.push_back(c);
                        else
                            add(c, sum_);
                    }
                }
            }
        return splats;
    }

    /// Adds the splats of all tiles up to the first that is not done. To be called under the lock.
    void add_splats_in_order()
    {
        for (; next_splats_ < tiles_.size() && waiting_[next_splats_]; ++next_splats_) {
            for (const Contribution& splat : *waiting_[next_splats_]) add(splat, splat_sum_);
            std::vector<Contribution>().swap(*waiting_[next_splats_]); // gives the memory back
        }
    }

    void add(const Contribution& c, images::Image& sum)
    {
        sum.pixels[c.pixel] += c.weight * c.value;
        if (layers_) layers_->add(c);
    }

    const World& world_;
    Integrator integrator_;
    const RenderOptions& options_;
    std::uint64_t number_;
    std::vector<Tile> tiles_;
    images::Image sum_; // in the end, the mean
    std::optional<StrategyLayers> layers_;

    std::atomic<std::size_t> next_tile_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_; // guards what follows
    std::size_t tiles_done_ = 0;
    std::vector<std::optional<std::vector<Contribution>>> waiting_; // per tile that is done: its splats
    std::size_t next_splats_ = 0;                                   // of the first tile that is not
    images::Image splat_sum_;
    images::Dropped dropped_;
    std::exception_ptr error_;
};

} // namespace

bool render(const World& world, Integrator integrator, const RenderOptions& options, images::Film& film,
            const Monitor& monitor, StrategyLayers* layers)
{
    const auto same_size = [&](int width, int height) {
        return width == world.camera.width() && height == world.camera.height();
    };
    if (!same_size(film.mean().width, film.mean().height) ||
        (layers != nullptr && !same_size(layers->width(), layers->height())))
        throw std::invalid_argument("film and camera differ in size");
    while (film.batches() < options.batches) {
        Batch batch(world, integrator, options, film.batches(), layers);
        if (!batch.run(monitor)) return false;
        film.add_batch(batch.mean());
        if (layers != nullptr) layers->add_batch(*batch.layers(), options.batch_size);
        if (monitor.batch) monitor.batch(batch.mean());
        if (monitor.kept) monitor.kept(film);
    }
    return true;
}

std::optional<images::Image> render_batch(const World& world, Integrator integrator,
                                          const RenderOptions& options, std::uint64_t number,
                                          const Monitor& monitor)
{
    Batch batch(world, integrator, options, number, nullptr);
    if (!batch.run(monitor)) return std::nullopt;
    return batch.mean();
}

} // namespace ref
