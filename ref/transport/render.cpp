#include "ref/transport/render.h"

#include <algorithm>
#include <atomic>
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
/// pixel's own samples one after the other, then what falls on it from elsewhere, tile by tile.
class Batch {
public:
    Batch(const World& world, Integrator integrator, const RenderOptions& options, std::uint64_t number)
        : world_(world), integrator_(integrator), options_(options), number_(number),
          tiles_(tiles_of(world.camera.width(), world.camera.height())), splats_(tiles_.size()),
          sum_(world.camera.width(), world.camera.height())
    {}

    /// The batch's mean per pixel, or nothing if `monitor` stopped it.
    std::optional<golden::Image> run(const Monitor& monitor)
    {
        {
            std::vector<std::jthread> helpers;
            for (unsigned i = 1; i < options_.threads; ++i) helpers.emplace_back([&] { work(monitor); });
            work(monitor);
        }
        if (error_) std::rethrow_exception(error_);
        if (stopped_) return std::nullopt;
        for (const auto& splats : splats_)
            for (const Contribution& splat : splats)
                sum_.pixels[splat.pixel] += splat.weight * splat.value;
        for (auto& pixel : sum_.pixels) pixel /= options_.batch_size;
        return std::move(sum_);
    }

private:
    void work(const Monitor& monitor)
    {
        try {
            for (std::size_t tile = next_tile_++; tile < tiles_.size() && !stopped_;
                 tile = next_tile_++) {
                if (monitor.stop && monitor.stop()) stopped_ = true;
                sample_tile(tile);
                const std::scoped_lock lock(mutex_);
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

    void sample_tile(std::size_t number)
    {
        const Tile& tile = tiles_[number];
        std::vector<Contribution> contributions;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * world_.camera.width() + x);
                for (std::uint32_t i = 0; i < options_.batch_size; ++i) {
                    const auto sample = static_cast<std::uint32_t>(number_ * options_.batch_size + i);
                    contributions.clear();
                    integrator_(world_, options_.path, {options_.path.seed, pixel, sample},
                                contributions);
                    for (const Contribution& c : contributions) {
                        if (c.pixel == pixel)
                            sum_.pixels[pixel] += c.weight * c.value;
                        else
                            splats_[number].push_back(c);
                    }
                }
            }
    }

    const World& world_;
    Integrator integrator_;
    const RenderOptions& options_;
    std::uint64_t number_;
    std::vector<Tile> tiles_;
    std::vector<std::vector<Contribution>> splats_; // per tile: what lands outside its own pixel
    golden::Image sum_;

    std::atomic<std::size_t> next_tile_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_; // guards what follows
    std::size_t tiles_done_ = 0;
    std::exception_ptr error_;
};

} // namespace

bool render(const World& world, Integrator integrator, const RenderOptions& options, golden::Film& film,
            const Monitor& monitor)
{
    if (film.mean().width != world.camera.width() || film.mean().height != world.camera.height())
        throw std::invalid_argument("film and camera differ in size");
    while (film.batches() < options.batches) {
        auto batch = Batch(world, integrator, options, film.batches()).run(monitor);
        if (!batch) return false;
        film.add_batch(*batch);
    }
    return true;
}

} // namespace ref
