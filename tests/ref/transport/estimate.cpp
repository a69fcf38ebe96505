#include "tests/ref/transport/estimate.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace transport_test {

std::vector<Batches> estimate(const ref::World& world, ref::Integrator integrator,
                              const EstimateOptions& options, int classes, const Classify& classify)
{
    const int width = world.camera.width();
    const int height = world.camera.height();
    std::vector<Batches> result(
        static_cast<std::size_t>(classes),
        Batches(static_cast<std::size_t>(options.batches), images::Image(width, height)));
    std::atomic<int> next = 0;
    const auto work = [&] {
        std::vector<ref::Contribution> contributions;
        for (int batch = next++; batch < options.batches; batch = next++)
            for (int i = 0; i < options.batch_size; ++i)
                for (int pixel = 0; pixel < width * height; ++pixel) {
                    contributions.clear();
                    integrator(world, options.path,
                               {options.path.seed, static_cast<std::uint32_t>(pixel),
                                static_cast<std::uint32_t>(batch * options.batch_size + i)},
                               contributions);
                    for (const ref::Contribution& c : contributions) {
                        const int kind = classify(c);
                        if (kind < 0 || kind >= classes) continue;
                        const double weight = options.weighted ? c.weight : 1.0;
                        result[static_cast<std::size_t>(kind)][static_cast<std::size_t>(batch)]
                            .pixels[c.pixel] +=
                            c.value * weight / static_cast<double>(options.batch_size);
                    }
                }
    };
    {
        const std::jthread helper(work);
        work();
    }
    return result;
}

Batches estimate(const ref::World& world, ref::Integrator integrator, const EstimateOptions& options)
{
    return estimate(world, integrator, options, 1, [](const ref::Contribution&) { return 0; }).front();
}

double mean_over(const images::Image& image, const Region& region, int channel)
{
    double sum = 0.0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x)
            sum += image.pixels[static_cast<std::size_t>(y * image.width + x)][channel];
    return sum / ((region.x1 - region.x0) * (region.y1 - region.y0));
}

Measured measure(std::span<const double> values)
{
    const auto n = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double v : values) mean += v / n;
    double squares = 0.0;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / (n * (n - 1.0))), static_cast<int>(values.size())};
}

Measured measure(const Batches& batches, const Region& region, int channel)
{
    std::vector<double> values;
    for (const images::Image& batch : batches) values.push_back(mean_over(batch, region, channel));
    return measure(values);
}

double t_quantile(double degrees, double level)
{
    return boost::math::quantile(boost::math::complement(boost::math::students_t(degrees), level));
}

double detectable_bias(double standard_error, double degrees)
{
    return standard_error * (t_quantile(degrees, alpha / 2.0) + t_quantile(degrees, 0.01));
}

void expect_mean(const Measured& measured, double expected, double specification)
{
    const double degrees = measured.batches - 1.0;
    EXPECT_LE(std::abs(measured.mean - expected),
              measured.standard_error * t_quantile(degrees, alpha / 2.0))
        << "mean " << measured.mean << " +- " << measured.standard_error << ", expected " << expected;
    EXPECT_LE(detectable_bias(measured.standard_error, degrees), specification * std::abs(expected))
        << "the test is too weak: standard error " << measured.standard_error << " of " << expected;
}

void expect_equal_means(const Measured& a, const Measured& b, double specification)
{
    const double va = a.standard_error * a.standard_error;
    const double vb = b.standard_error * b.standard_error;
    const double error = std::sqrt(va + vb);
    if (error == 0.0) {
        EXPECT_EQ(a.mean, b.mean);
        return;
    }
    const double degrees =
        (va + vb) * (va + vb) / (va * va / (a.batches - 1.0) + vb * vb / (b.batches - 1.0));
    EXPECT_LE(std::abs(a.mean - b.mean), error * t_quantile(degrees, alpha / 2.0))
        << a.mean << " +- " << a.standard_error << " against " << b.mean << " +- " << b.standard_error;
    EXPECT_LE(detectable_bias(error, degrees),
              specification * std::max(std::abs(a.mean), std::abs(b.mean)))
        << "the test is too weak: standard error " << error << " of " << a.mean;
}

} // namespace transport_test
