#pragma once

// The mean of a whole picture, over all channels, batch by batch, from the fast path or from the
// reference, for tests that compare renderers.

#include "cuda/launch/renderer.h"
#include "ref/transport/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace fast_transport_test {

/// One number per batch.
using Means = std::vector<double>;

/// The number of samples: a square picture of `size` pixels a side.
struct Samples {
    int size;
    std::uint64_t batches;
    std::uint32_t batch_size;
};

inline double mean_of(const images::Image& image)
{
    double sum = 0;
    for (const auto& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

inline Means means_by_ref(const scenes::Scene& scene, ref::Integrator integrator, int max_edges,
                          std::uint64_t seed, const Samples& samples)
{
    const ref::World world(scene, samples.size, samples.size);
    const auto renderer = ref::renderer(
        world, integrator, {.seed = seed, .max_edges = max_edges, .batch_size = samples.batch_size});
    Means means;
    for (std::uint64_t i = 0; i < samples.batches; ++i)
        means.push_back(mean_of(renderer->render_batch(i)->mean));
    return means;
}

/// Contributions that are not finite make the test fail.
inline Means means_by_host(const scenes::Scene& scene, fast::Integrator integrator, int max_edges,
                           std::uint64_t seed, const Samples& samples)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = max_edges;
    options.seed = seed;
    options.batch_size = samples.batch_size;
    const auto renderer = fast::host_renderer(scene, samples.size, samples.size, options, 1);
    Means means;
    for (std::uint64_t i = 0; i < samples.batches; ++i) {
        const images::Batch batch = *renderer->render_batch(i, {});
        EXPECT_EQ(batch.dropped.count, 0u);
        means.push_back(mean_of(batch.mean));
    }
    return means;
}

inline double average(const Means& means)
{
    double sum = 0;
    for (const double m : means) sum += m;
    return sum / static_cast<double>(means.size());
}

/// The standard error of the average.
inline double error_of(const Means& means)
{
    const double middle = average(means);
    double squares = 0;
    for (const double m : means) squares += (m - middle) * (m - middle);
    const auto count = static_cast<double>(means.size());
    return std::sqrt(squares / (count * (count - 1)));
}

} // namespace fast_transport_test
