// The mean of very many equal samples: a pixel with light that does not vary.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"
#include "extremes/sums/equal_terms.h"
#include "extremes/sums/means.h"

#include <cmath>
#include <stdexcept>

namespace extremes {

namespace {

/// The film after n equal samples. A block of two equal halves is that half: all distances are 0. So
/// each block of the film is the batch, and the film need not be filled.
template <class F, std::uint64_t batch_size>
double film_of_equal(float x, std::uint64_t n)
{
    const std::uint64_t in_batch = std::min(batch_size, n);
    const F sum = sum_of_equal(static_cast<F>(x), in_batch);
    const images::Image batch = batch_of(static_cast<double>(sum / static_cast<F>(in_batch)));
    images::Film film{1, 1};
    film.add_batch(batch);
    film.add_batch(batch);
    const images::BatchMoments one{batch, images::Image{1, 1}};
    if (film.blocks() != std::vector{one})
        throw std::logic_error("a film of two equal batches is not that batch");
    if (const std::uint64_t batches = n / in_batch; batches > 1) {
        const images::BatchRange range{0, batches - 1};
        film = images::Film(1, 1, range, std::vector(largest_blocks(range).size(), one));
        film.add_batch(batch);
    }
    return film.mean().pixels[0].r;
}

double deterministic_mean_of_equal(float x, std::uint64_t n)
{
    return DeterministicMean{exact_sum_of_equal(x, n)}.mean(n);
}

auto equal_samples_cases(double (*mean)(float x, std::uint64_t n))
{
    return [mean](double parameter, Random& random, int cases, Tally& tally) {
        const auto n = static_cast<std::uint64_t>(parameter);
        for (int i = 0; i < cases; ++i) {
            const auto x = static_cast<float>(
                std::ldexp(random.between(1, 2), static_cast<int>(random.below(64)) - 32));
            tally.add(relative_error(mean(x, n), Exact(x)));
        }
    };
}

} // namespace

Axis equal_samples_axis()
{
    constexpr double u64 = 0x1p-53;
    constexpr double u32 = 0x1p-24;
    Axis axis;
    axis.number = 13;
    axis.name = "equal-samples";
    axis.title = "The mean of many equal samples";
    axis.parameter = "number of samples";
    axis.about =
        "A case is the mean of equal samples: light that does not vary, the worst case of a sum. "
        "The truth is the sample. Sums of more terms than there is time for are computed bit for "
        "bit without adding each: between two powers of two, each addition changes the sum by "
        "the same amount.";
    axis.ordinary = 64;
    axis.logarithmic = true;
    for (int k = 0; k <= 60; k += 2) axis.values.push_back(std::ldexp(1.0, k));
    axis.methods = {
        {"ref", Format::binary64, equal_samples_cases(film_of_equal<double, samples_of_batch>)},
        {"host", Format::binary32, equal_samples_cases(film_of_equal<float, samples_of_batch>)},
        {"ref, one batch", Format::binary64, equal_samples_cases(film_of_equal<double, one_batch>)},
        {"host, one batch", Format::binary32, equal_samples_cases(film_of_equal<float, one_batch>)},
        {"host, deterministic", Format::binary32, equal_samples_cases(deterministic_mean_of_equal)},
    };
    const std::string kept = "from the first batch on the mean is the sample, and the film keeps it; "
                             "nothing fails up to here, the most that is tried";
    const auto stops = [](const std::string& bits, const std::string& safe) {
        return "each addition rounds by up to 2^-" + bits +
               " of the sum, and always to the same side; at 2^" + bits +
               " terms the sum stops growing. " + safe + " samples are within 1%";
    };
    axis.limits = {
        {"ref", 0x1p60, [](double) { return 5 * u64; }, no_failure, Failure::inaccurate, kept},
        {"host", 0x1p60, [](double) { return 5 * u32; }, no_failure, Failure::inaccurate, kept},
        // n - 1 additions, the number n itself, and the division.
        {"ref, one batch", 0x1p46, [](double n) { return (n + 1) * u64; }, 0x1p50, Failure::inaccurate,
         stops("53", "2^46")},
        {"host, one batch", 0x1p17, [](double n) { return (n + 1) * u32; }, 0x1p20, Failure::inaccurate,
         stops("24", "2^17")},
        {"host, deterministic", 0x1p32, [](double) { return 12 * u64; }, 0x1p33, Failure::inaccurate,
         "a word of the sum has 64 bits, and a term adds less than 2^32 to it: 2^32 terms never "
         "overflow"},
    };
    axis.derivation = "the sum of $n$ equal terms $x$ is a multiple of its unit in the last place, "
                      "$2^{1-p}$ of a power "
                      "of two for $p$ digits, and each term is rounded to a multiple of that unit: by "
                      "up to $2^{-p}$ of "
                      "the sum, which is $n 2^{-p}$ of a term. So the relative error is below $n u$, "
                      "with $u = 2^{-p}$, "
                      "and where a term is less than half a unit, the sum does not change any more.";
    return axis;
}

} // namespace extremes
