#include "explain/search.h"

#include "explain/names.h"
#include "ref/transport/renderer.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace explain {

namespace {

/// Rec.709.
double luminance(const Rgb& v)
{
    return glm::dot(v, Rgb(0.2126, 0.7152, 0.0722));
}

/// Whether the condition holds for a contribution of the sample. Only contributions are computed, which
/// is faster than an explanation.
std::optional<Found> among_contributions(const Condition& condition, const ref::SampleId& id,
                                         const std::vector<ref::Contribution>& contributions)
{
    for (const ref::Contribution& c : contributions) {
        Strategy strategy{c.s, c.t};
        strategy.made = c;
        if (condition.holds(strategy)) return Found{id, c.s, c.t};
    }
    return std::nullopt;
}

std::optional<Found> among_strategies(const Condition& condition, const ref::SampleId& id,
                                      const Sample& sample)
{
    for (const Strategy& strategy : sample.strategies)
        if (condition.holds(strategy)) return Found{id, strategy.s, strategy.t};
    return std::nullopt;
}

/// The sums over the samples of a picture, and for each pixel the sample number that gave it most.
struct Extremes {
    std::vector<double> sum, largest;
    std::vector<std::uint32_t> sample; // of the largest

    explicit Extremes(std::size_t pixels) : sum(pixels, 0.0), largest(pixels, 0.0), sample(pixels, 0) {}

    void add(const images::Image& image, std::uint32_t number)
    {
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double value = luminance(image.pixels[i]);
            sum[i] += value;
            if (value <= largest[i]) continue;
            largest[i] = value;
            sample[i] = number;
        }
    }

    /// The mean of pixel i over all samples but the largest.
    [[nodiscard]] double others(std::size_t i, std::uint32_t samples) const
    {
        return samples == 1 ? 0.0 : (sum[i] - largest[i]) / (samples - 1);
    }

    [[nodiscard]] double raise(std::size_t i, std::uint32_t samples) const
    {
        return sum[i] / samples - others(i, samples);
    }
};

/// The largest contribution to the pixel among the samples of one number.
void find_cause(const ref::World& world, const images::RenderOptions& options, Firefly& firefly)
{
    const ref::PathOptions path = ref::path_options(options);
    const ref::Integrator integrate = ref::integrator_of(options.integrator);
    const auto pixels = static_cast<std::uint32_t>(world.camera.width()) *
                        static_cast<std::uint32_t>(world.camera.height());
    firefly.adds = -1.0;
    std::vector<ref::Contribution> contributions;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const ref::SampleId id{options.seed, pixel, firefly.sample};
        contributions.clear();
        integrate(world, path, id, contributions);
        for (const ref::Contribution& c : contributions) {
            const double adds = luminance(c.weight * c.value);
            if (c.pixel != firefly.pixel || !(adds > firefly.adds) || !std::isfinite(adds)) continue;
            firefly.adds = adds;
            firefly.cause = {id, c.s, c.t};
        }
    }
}

} // namespace

std::optional<Found> find_first(const ref::World& world, const images::RenderOptions& options,
                                const Range& range, const Condition& condition,
                                const images::Monitor& monitor, bool& stopped)
{
    const ref::PathOptions path = ref::path_options(options);
    const ref::Integrator integrate = ref::integrator_of(options.integrator);
    const auto pixels = static_cast<std::uint32_t>(world.camera.width()) *
                        static_cast<std::uint32_t>(world.camera.height());
    const std::uint32_t begin = range.pixel.value_or(0);
    const std::uint32_t end = range.pixel ? begin + 1 : pixels;
    std::vector<ref::Contribution> contributions;
    for (std::uint32_t sample = 0; sample < range.samples; ++sample)
        for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
            const ref::SampleId id{options.seed, pixel, sample};
            std::optional<Found> found;
            if (condition.has_obstacle()) {
                found =
                    among_strategies(condition, id, explain_sample(world, options.integrator, path, id));
            } else {
                contributions.clear();
                integrate(world, path, id, contributions);
                found = among_contributions(condition, id, contributions);
            }
            if (found) return found;
            if (monitor.progress)
                monitor.progress(sample + static_cast<double>(pixel + 1 - begin) / (end - begin));
            stopped = monitor.stop && monitor.stop();
            if (stopped) return std::nullopt;
        }
    return std::nullopt;
}

std::optional<Firefly> find_firefly(const ref::World& world, images::RenderOptions options,
                                    std::uint32_t samples, unsigned threads,
                                    const images::Monitor& monitor, bool& stopped)
{
    options.batch_size = 1; // so that a batch is the samples of one number
    const auto renderer = ref::renderer(world, ref::integrator_of(options.integrator), options, threads);
    const auto pixels =
        static_cast<std::size_t>(world.camera.width()) * static_cast<std::size_t>(world.camera.height());
    Extremes extremes(pixels);
    std::uint32_t number = 0;
    stopped = !images::render_batches(*renderer, 0, samples, monitor, [&](const images::Batch& batch) {
        extremes.add(batch.mean, number++);
    });
    if (stopped) return std::nullopt;
    std::size_t most = 0;
    for (std::size_t i = 1; i < pixels; ++i)
        if (extremes.raise(i, samples) > extremes.raise(most, samples)) most = i;
    if (extremes.largest[most] == 0.0) return std::nullopt;
    Firefly firefly{static_cast<std::uint32_t>(most),
                    extremes.sample[most],
                    extremes.sum[most] / samples,
                    extremes.others(most, samples),
                    {},
                    0.0};
    find_cause(world, options, firefly);
    return firefly;
}

std::string describe(const Found& found, const std::string& condition)
{
    return "Strategy (" + std::to_string(found.s) + "," + std::to_string(found.t) +
           ") is the first with " + condition + "\n";
}

std::string describe(const Firefly& firefly, int width)
{
    const Found& cause = firefly.cause;
    return "Pixel " + pixel_name(firefly.pixel, width) + ": luminance " + number(firefly.mean) +
           ", and " + number(firefly.others) + " without the samples of number " +
           std::to_string(firefly.sample) + "\nOf these, strategy (" + std::to_string(cause.s) + "," +
           std::to_string(cause.t) + ") of pixel " + pixel_name(cause.id.pixel, width) +
           " adds most: luminance " + number(firefly.adds) + "\n";
}

} // namespace explain
