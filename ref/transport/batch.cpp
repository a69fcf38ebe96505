#include "ref/transport/batch.h"

#include "ref/trees/aabb.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
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

/// Sums of the pictures of all strategies (s, t) of at most `max_edges` edges.
class StrategyImages {
public:
    StrategyImages(int width, int height, int max_edges, bool weighted)
        : max_edges_(max_edges), weighted_(weighted),
          sums_(index_of(max_edges, 1) + 1, images::Image(width, height))
    {}

    void add(const Contribution& c)
    {
        sums_[index_of(c.s, c.t)].pixels[c.pixel] += weighted_ ? c.weight * c.value : c.value;
    }

    /// Moves the pictures out.
    [[nodiscard]] images::Strategies take()
    {
        images::Strategies result;
        for (int k = 1; k <= max_edges_; ++k)
            for (int s = 0; s <= k; ++s)
                result.emplace(std::pair(s, k + 1 - s), std::move(sums_[index_of(s, k + 1 - s)]));
        return result;
    }

private:
    /// A path of k edges has k + 1 strategies, s = 0 ... k. They come after those of 1 ... k - 1
    /// edges.
    static std::size_t index_of(int s, int t)
    {
        const int k = s + t - 1;
        return static_cast<std::size_t>((k - 1) * (k + 2) / 2 + s);
    }

    int max_edges_;
    bool weighted_;
    std::vector<images::Image> sums_;
};

/// One batch while it is computed. The order of all sums is fixed and does not depend on the threads:
/// first a pixel's own samples, one after the other; separately the splats of light walks on it, tile
/// by tile; then the sum of both. The splats of a tile that is done before its turn are stored; the
/// others are summed at once, because the splats of a whole picture would not fit in memory.
class BatchSums {
public:
    BatchSums(const World& world, Integrator integrator, const images::RenderOptions& options,
              std::uint64_t number)
        : world_(world), integrator_(integrator), options_(options), number_(number),
          tiles_(tiles_of(world.camera.width(), world.camera.height())),
          sum_(world.camera.width(), world.camera.height()), waiting_(tiles_.size()),
          splat_sum_(world.camera.width(), world.camera.height())
    {
        if (options.strategies != images::StrategyPictures::none)
            strategies_.emplace(sum_.width, sum_.height, options.max_edges,
                                options.strategies == images::StrategyPictures::weighted);
    }

    /// The batch, unless `monitor` stopped it.
    std::optional<images::Batch> run(unsigned threads, const images::Monitor& monitor)
    {
        {
            std::vector<std::jthread> helpers;
            for (unsigned i = 1; i < threads; ++i) helpers.emplace_back([&] { work(monitor); });
            work(monitor);
        }
        if (error_) std::rethrow_exception(error_);
        if (stopped_) return std::nullopt;
        for (std::size_t i = 0; i < sum_.pixels.size(); ++i)
            sum_.pixels[i] =
                // map: splat
                (sum_.pixels[i] + splat_sum_.pixels[i]) / static_cast<double>(options_.batch_size);
        return images::Batch{std::move(sum_), strategies_ ? strategies_->take() : images::Strategies{},
                             dropped_};
    }

private:
    void work(const images::Monitor& monitor)
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

    /// Adds the contributions of the tile's samples to their own pixels, and returns their splats on
    /// any pixel: the light image, t = 1. No other thread accesses the tile's pixels, nor its
    /// strategies of t > 1 there. Contributions that are not finite go to `dropped`.
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
                    integrator_(world_, path_, {path_.seed, pixel, sample}, contributions);
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

    /// Adds the splats of all tiles up to the first one that is not done. The caller must hold the
    /// lock.
    void add_splats_in_order()
    {
        for (; next_splats_ < tiles_.size() && waiting_[next_splats_]; ++next_splats_) {
            // map: splat
            for (const Contribution& splat : *waiting_[next_splats_]) add(splat, splat_sum_);
            std::vector<Contribution>().swap(*waiting_[next_splats_]); // frees the memory
        }
    }

    void add(const Contribution& c, images::Image& sum)
    {
        sum.pixels[c.pixel] += c.weight * c.value;
        if (strategies_) strategies_->add(c);
    }

    const World& world_;
    Integrator integrator_;
    const images::RenderOptions& options_;
    PathOptions path_ = path_options(options_);
    std::uint64_t number_;
    std::vector<Tile> tiles_;
    images::Image sum_; // finally the mean
    std::optional<StrategyImages> strategies_;

    std::atomic<std::size_t> next_tile_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_; // guards the members below
    std::size_t tiles_done_ = 0;
    std::vector<std::optional<std::vector<Contribution>>> waiting_; // splats per tile; empty: not done
    std::size_t next_splats_ = 0;                                   // the first tile that is not done
    images::Image splat_sum_;
    images::Dropped dropped_;
    std::exception_ptr error_;
};

} // namespace

std::optional<images::Batch> sample_batch(const World& world, Integrator integrator,
                                          const images::RenderOptions& options, std::uint64_t number,
                                          unsigned threads, const images::Monitor& monitor)
{
    return BatchSums(world, integrator, options, number).run(threads, monitor);
}

} // namespace ref
