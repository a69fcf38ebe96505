#pragma once

// Renders batches of samples, one launch after the other, on any executor.

#include "cuda/launch/launch_samples.h"
#include "cuda/launch/renderer.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <stdexcept>
#include <string>

namespace fast {

/// Limits on the samples of a launch, and on the memory of their light vertices and queues.
struct LaunchLimits {
    std::uint32_t least, most;
    std::size_t most_bytes;
};

/// The number of samples per launch. A GPU that also drives a screen aborts kernels that run for some
/// seconds, and Ctrl-C takes effect only after a launch; but short launches leave processors idle at
/// their ends. So the size of launches is adapted, between limits, until one takes about the intended
/// time. The size changes no sum except that of splats as floats.
class LaunchSize {
public:
    /// `bytes`: the memory per sample.
    LaunchSize(LaunchLimits limits, std::size_t bytes) : least_(limits.least), most_(limits.most)
    {
        while (most_ > 1 && most_ * bytes > limits.most_bytes) most_ /= 2;
        least_ = std::min(least_, most_);
        size_ = least_;
    }
    [[nodiscard]] std::uint32_t get() const { return size_; }
    [[nodiscard]] std::uint32_t most() const { return most_; }
    void took(std::chrono::duration<double> time)
    {
        if (time.count() < 0.03 && size_ <= most_ / 2) size_ *= 2;
        if (time.count() > 0.12 && size_ / 2 >= least_) size_ /= 2;
    }

private:
    std::uint32_t least_, most_, size_;
};

/// The most elements or pixels of one launch: an index has 32 bits.
constexpr std::size_t most_per_launch = 0xffff'ffff;

/// The number of pixels of a picture. Throws std::invalid_argument if it is 0 or more than an index
/// can count.
inline std::uint32_t pixel_count(int width, int height)
{
    const std::int64_t pixels = std::int64_t{width} * height;
    if (width < 1 || height < 1 || pixels > static_cast<std::int64_t>(most_per_launch))
        throw std::invalid_argument("a picture of " + std::to_string(width) + "x" +
                                    std::to_string(height) + " pixels: expected 1 to " +
                                    std::to_string(most_per_launch) + " pixels");
    return static_cast<std::uint32_t>(pixels);
}

/// The first sample number of batch `number`, with `batch_size` samples per pixel. Throws
/// std::invalid_argument for a batch that goes beyond 32 bits: its random numbers would be those of an
/// earlier one.
inline std::uint32_t first_sample_of(std::uint64_t number, std::uint32_t batch_size)
{
    if (batch_size > 0 && number >= (std::uint64_t{1} << 32) / batch_size)
        throw std::invalid_argument("batch " + std::to_string(number) + " of " +
                                    std::to_string(batch_size) +
                                    " samples per pixel: a pixel has at most 2^32 samples");
    return static_cast<std::uint32_t>(number * batch_size);
}

/// Throws std::invalid_argument for an option that only the reference has.
inline void expect_fast_options(const images::RenderOptions& options)
{
    const auto refuse = [](const std::string& option) {
        throw std::invalid_argument("the fast path has no " + option + ": only the reference does");
    };
    if (options.roulette_from != bounces_without_roulette + 1)
        refuse("choice of the first bounce of roulette");
    if (options.heuristic == images::Heuristic::uniform) refuse("uniform weights");
    if (!(options.families == images::Families{})) refuse("choice of the families of strategies");
}

/// Queues the assignment of the default value to all elements, in launches of at most `most`: a large
/// picture with layers may have more exact sums than an index can count.
template <class T, Executor E>
void clear(E& executor, std::span<T> elements, std::size_t most = most_per_launch)
{
    while (!elements.empty()) {
        const std::size_t count = std::min(elements.size(), most);
        executor(static_cast<std::uint32_t>(count), Clear<T>{elements.first(count)});
        elements = elements.subspan(count);
    }
}

/// A Renderer on an executor whose kernels access `memory`, and whose wait() returns when all queued
/// work is done.
template <Executor E>
class BatchRenderer : public Renderer {
public:
    BatchRenderer(Memory& memory, E& executor, const LaunchLimits& limits, const scenes::Scene& scene,
                  int width, int height, const images::RenderOptions& options,
                  const RendererOptions& choices)
        : BatchRenderer(memory, executor, limits, scene, scene_arrays(scene, options.roulette), width,
                        height, options, choices)
    {}

    [[nodiscard]] Needs needs() const override { return needs_; }
    [[nodiscard]] TreeBuilder tree() const override { return scene_.tree(); }

private:
    std::optional<images::Batch> make_batch(std::uint64_t number,
                                            const images::Monitor& monitor) override
    {
        const std::uint32_t first = first_sample_of(number, options_.batch_size);
        clear(executor_, sums_.all());
        clear(executor_, splats_.all());
        clear(executor_, exact_.all());
        clear(executor_, layers_.all());
        clear(executor_, dropped_.all());
        std::uint64_t done = 0;
        const std::uint64_t all = std::uint64_t{pixels_} * options_.batch_size;
        // All samples of as many pixels as a launch takes, then the next pixels.
        for (std::uint32_t pixel = 0; pixel < pixels_;) {
            const std::uint32_t width = std::min(launch_size_.get(), pixels_ - pixel);
            for (std::uint32_t sample = 0; sample < options_.batch_size;) {
                if (monitor.stop && monitor.stop()) return std::nullopt;
                const std::uint32_t at_once = options_.strategies == images::StrategyPictures::none
                                                  ? std::max(launch_size_.get() / width, 1u)
                                                  : 1u;
                const Launch launch{pixel, width, first + sample,
                                    std::min(at_once, options_.batch_size - sample)};
                const auto start = std::chrono::steady_clock::now();
                run(launch);
                executor_.wait();
                launch_size_.took(std::chrono::steady_clock::now() - start);
                sample += launch.samples;
                done += launch.count();
                if (monitor.progress)
                    monitor.progress(static_cast<double>(number) +
                                     static_cast<double>(done) / static_cast<double>(all));
            }
            pixel += width;
        }
        add_copies();
        return collect();
    }

    BatchRenderer(Memory& memory, E& executor, const LaunchLimits& limits, const scenes::Scene& scene,
                  const SceneArrays& arrays, int width, int height, const images::RenderOptions& options,
                  const RendererOptions& choices)
        : executor_(executor), options_(checked(options)), width_(width), height_(height),
          pixels_(pixel_count(width, height)), needs_(compiled_for(arrays.needs | choices.at_least)),
          scene_(memory, builder_of(executor), arrays, camera_of(scene, arrays.place, width, height),
                 choices.tree),
          capacity_(options_.integrator == Integrator::bdpt
                        ? most_light_vertices(arrays, options_.max_edges)
                        : 0),
          launch_size_(limits, static_cast<std::size_t>(capacity_) * sizeof(LightVertex) +
                                   (words_of_queues(1) - words_of_queues(0)) * sizeof(std::uint32_t)),
          own_(memory, launch_size_.most()),
          kept_(memory, static_cast<std::size_t>(capacity_) * launch_size_.most()),
          queues_(memory, words_of_queues(launch_size_.most())), sums_(memory, pixels_),
          splat_copies_(options_.integrator == Integrator::path
                            ? 1
                            : splat_copies(executor, splat_pictures() * pixels_ * sizeof(Rgb))),
          splats_(memory, options.deterministic ? 0 : splat_copies_ * splat_pictures() * pixels_),
          exact_(memory, options.deterministic ? 3 * splat_pictures() * pixels_ : 0),
          layers_(memory, options.strategies == images::StrategyPictures::none
                              ? 0
                              : layer_count() * std::size_t{pixels_}),
          dropped_(memory, 1)
    {}

    static images::RenderOptions checked(images::RenderOptions options)
    {
        images::check(options);
        expect_fast_options(options);
        options.max_edges = std::min(options.max_edges, most_edges);
        return options;
    }
    /// One picture of all splats; with layers, one more for each strategy (s, 1).
    [[nodiscard]] std::size_t splat_pictures() const
    {
        return options_.strategies == images::StrategyPictures::none
                   ? 1
                   : 1 + static_cast<std::size_t>(options_.max_edges);
    }
    [[nodiscard]] std::size_t words_of_queues(std::uint32_t samples) const
    {
        return queue_words(executor_, options_.integrator, samples);
    }
    [[nodiscard]] std::size_t layer_count() const { return layer_of(options_.max_edges, 1) + 1; }

    void run(const Launch& launch)
    {
        const PathOptions path{options_.seed, options_.max_edges, options_.heuristic};
        const FilmTarget film{own_.all(),
                              {splats_.all(), exact_.all(), splat_copies_},
                              layers_.all(),
                              dropped_.all(),
                              options_.strategies == images::StrategyPictures::weighted,
                              pixels_};
        const SampleJob job{path, launch, film, kept_.all(), capacity_, queues_.all()};
        switch (options_.integrator) {
        case Integrator::path:
            launch_samples<Integrator::path>(executor_, needs_, scene_, job);
            break;
        case Integrator::bdpt:
            launch_samples<Integrator::bdpt>(executor_, needs_, scene_, job);
            break;
        case Integrator::light:
            launch_samples<Integrator::light>(executor_, needs_, scene_, job);
            break;
        }
        executor_(launch.pixels, SumSamples{own_.all(), sums_.all(), launch.first_pixel, launch.pixels,
                                            launch.samples});
    }

    /// Adds the splats of all threads to those of the first.
    void add_copies()
    {
        if (splat_copies_ == 1 || options_.deterministic) return;
        executor_(static_cast<std::uint32_t>(splat_pictures() * pixels_),
                  AddCopies{splats_.all(), splat_copies_});
        executor_.wait();
    }

    /// The splats of picture i; see SplatTarget.
    [[nodiscard]] images::Image splats(std::size_t picture) const
    {
        images::Image image(width_, height_);
        const std::size_t first = picture * pixels_;
        if (options_.deterministic) {
            const std::vector<ExactSum> sums = exact_.read(3 * first, 3 * std::size_t{pixels_});
            for (std::size_t i = 0; i < pixels_; ++i)
                image.pixels[i] = {sums[3 * i].value(), sums[3 * i + 1].value(),
                                   sums[3 * i + 2].value()};
        } else {
            const std::vector<Rgb> sums = splats_.read(first, pixels_);
            for (std::size_t i = 0; i < pixels_; ++i) image.pixels[i] = images::Rgb(sums[i]);
        }
        return image;
    }

    [[nodiscard]] images::Dropped dropped() const
    {
        const auto [count, key] = dropped_.read(1)[0];
        if (count == 0) return {};
        return {count, static_cast<std::uint32_t>(key >> 32), static_cast<int>(key >> 16 & 0xffff),
                static_cast<int>(key & 0xffff)};
    }

    [[nodiscard]] images::Batch collect() const
    {
        images::Batch batch;
        batch.dropped = dropped();
        batch.mean = splats(0);
        const std::vector<Rgb> own = sums_.read(pixels_);
        for (std::size_t i = 0; i < pixels_; ++i)
            batch.mean.pixels[i] =
                // map: splat
                (images::Rgb(own[i]) + batch.mean.pixels[i]) / static_cast<double>(options_.batch_size);
        if (options_.strategies == images::StrategyPictures::none) return batch;
        for (int k = 1; k <= options_.max_edges; ++k)
            for (int s = 0; s <= k; ++s) {
                images::Image image(width_, height_);
                if (s == k) {
                    image = splats(static_cast<std::size_t>(s));
                } else {
                    const std::vector<Rgb> sums =
                        layers_.read(std::size_t{layer_of(s, k + 1 - s)} * pixels_, pixels_);
                    for (std::size_t i = 0; i < pixels_; ++i) image.pixels[i] = images::Rgb(sums[i]);
                }
                batch.strategies.emplace(std::pair(s, k + 1 - s), std::move(image));
            }
        return batch;
    }

    E& executor_;
    images::RenderOptions options_;
    int width_, height_;
    std::uint32_t pixels_;
    Needs needs_;
    SceneInMemory scene_;
    int capacity_; // of the light vertices of a sample
    LaunchSize launch_size_;
    Buffer<Rgb> own_;
    Buffer<LightVertex> kept_;
    Buffer<std::uint32_t> queues_;
    Buffer<Rgb> sums_;
    std::size_t splat_copies_;
    Buffer<Rgb> splats_;
    Buffer<ExactSum> exact_;
    Buffer<Rgb> layers_;
    Buffer<DroppedCount> dropped_;
};

} // namespace fast
