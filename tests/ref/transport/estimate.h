#pragma once

// Renders small pictures batch by batch, keeps every batch, and tests means against known values.

#include "images/image.h"
#include "ref/transport/world.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace transport_test {

/// The class of a contribution, 0 <= class < classes; contributions with any other value are left out.
using Classify = std::function<int(const ref::Contribution&)>;

/// Batches of pictures of one class of contributions: batches[b] is the mean of batch b.
using Batches = std::vector<images::Image>;

struct EstimateOptions {
    int batches = 32;
    int batch_size = 4;
    bool weighted = true; // false: each contribution as if its strategy were the only one
    ref::PathOptions path{};
};

/// One set of batches per class. Runs on two threads; the result does not depend on their number,
/// because a batch is summed by one thread in sample order.
std::vector<Batches> estimate(const ref::World& world, ref::Integrator integrator,
                              const EstimateOptions& options, int classes, const Classify& classify);

/// All contributions in one class.
Batches estimate(const ref::World& world, ref::Integrator integrator, const EstimateOptions& options);

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Region {
    int x0, y0, x1, y1;
};

inline Region whole(const images::Image& image)
{
    return {0, 0, image.width, image.height};
}

/// Mean of one channel over a region.
double mean_over(const images::Image& image, const Region& region, int channel);

/// Mean and its standard error from independent equal batches.
struct Measured {
    double mean, standard_error;
    int batches;
};

Measured measure(std::span<const double> values);

/// The same for one channel over a region.
Measured measure(const Batches& batches, const Region& region, int channel);

/// Two-sided level of every single comparison below. With a few thousand comparisons in the suite, a
/// change of all seeds gives a false alarm about once in some hundred times. Seeds are fixed, so a
/// passing test goes on passing.
inline constexpr double alpha = 1e-6;

/// The value that Student's t with `degrees` degrees of freedom exceeds with a probability of `level`.
double t_quantile(double degrees, double level);

/// The bias that a comparison with this standard error detects with a power of 99%.
double detectable_bias(double standard_error, double degrees);

/// Student's t test of a measured mean against the true one. It also fails if the test could not have
/// detected a bias of the fraction `specification` of the expected value: a test without power is
/// worthless.
void expect_mean(const Measured& measured, double expected, double specification);

/// Welch's t test of two measured means, with the same requirement on its power.
void expect_equal_means(const Measured& a, const Measured& b, double specification);

} // namespace transport_test
