// The mean of very many samples.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"

#include "cuda/transport/exact_sum.h"
#include "images/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremes {

namespace {

constexpr std::uint64_t samples_of_batch = 4; // RenderOptions::batch_size

/// Uniform on [0, 1): a multiple of 2^-24, so that it is a float, and sums of 2^40 of them are integers
/// of 64 bits.
std::uint64_t sample_in_units(Random& random)
{
    return random.bits() >> 40;
}

/// A method: Mean has add(float) and mean(count).
template <class Mean>
void run_mean(double parameter, Random& random, int cases, Tally& tally)
{
    auto count = static_cast<std::uint64_t>(parameter);
    if (count > samples_of_batch) count -= count % samples_of_batch; // whole batches
    for (int i = 0; i < cases; ++i) {
        Mean mean;
        std::uint64_t sum = 0;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::uint64_t units = sample_in_units(random);
            sum += units;
            mean.add(static_cast<float>(units) * 0x1p-24f);
        }
        const Exact truth = Exact(sum) / (Exact(count) * 0x1p24);
        if (truth == 0)
            tally.add(mean.mean(count));
        else
            tally.add(relative_error(mean.mean(count), truth));
    }
}

template <class F>
struct NaiveMean {
    F sum = 0;
    void add(float x) { sum += static_cast<F>(x); }
    [[nodiscard]] double mean(std::uint64_t count) const
    {
        return static_cast<double>(sum / static_cast<F>(count));
    }
};

struct KahanMean { // compensated summation [Kahan 1965]
    float sum = 0, lost = 0;
    void add(float x)
    {
        const float y = x - lost;
        const float t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    [[nodiscard]] double mean(std::uint64_t count) const { return sum / static_cast<float>(count); }
};

struct RunningMean { // in floats, as of a progressive preview
    float value = 0, count = 0;
    void add(float x)
    {
        count += 1.0f;
        value += (x - value) / count;
    }
    [[nodiscard]] double mean(std::uint64_t /*count*/) const { return value; }
};

/// The film of a picture of one pixel. Samples of a batch are summed in the format F: the reference sums
/// doubles, the fast path floats.
template <class F, std::uint64_t batch_size>
struct FilmMean {
    images::Film film{1, 1};
    images::Image batch{1, 1};
    F sum = 0;
    std::uint64_t in_batch = 0;
    void add(float x)
    {
        sum += static_cast<F>(x);
        if (++in_batch == batch_size) finish();
    }
    void finish()
    {
        batch.pixels[0] =
            images::Rgb(static_cast<double>(sum / static_cast<F>(std::min(batch_size, in_batch))));
        film.add_batch(batch);
        sum = 0;
        in_batch = 0;
    }
    [[nodiscard]] double mean(std::uint64_t /*count*/)
    {
        if (in_batch > 0) finish();
        return film.mean().pixels[0].r;
    }
};

struct DeterministicMean { // the splats of --deterministic
    fast::ExactSum sum{};
    void add(float x) { sum.add(x); }
    [[nodiscard]] double mean(std::uint64_t count) const
    {
        return sum.value() / static_cast<double>(count);
    }
};

} // namespace

Axis samples_axis()
{
    constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
    constexpr double u64 = 0x1p-53;
    constexpr double u32 = 0x1p-24;
    Axis axis;
    axis.number = 13;
    axis.name = "samples";
    axis.title = "The mean of many samples";
    axis.parameter = "number of samples";
    axis.about = "A case is the mean of random numbers, uniform on [0, 1). The error is relative to the "
                 "mean. The "
                 "truth is a sum of integers: every sample is a multiple of 2^-24.";
    axis.ordinary = 64;
    axis.logarithmic = true;
    for (int k = 0; k <= 28; k += 2) axis.values.push_back(std::ldexp(1.0, k));
    axis.most_cases = 1;
    axis.methods = {
        {"ref", Format::binary64, run_mean<FilmMean<double, samples_of_batch>>},
        {"host", Format::binary32, run_mean<FilmMean<float, samples_of_batch>>},
        {"host, one batch", Format::binary32, run_mean<FilmMean<float, any>>},
        {"host, deterministic", Format::binary32, run_mean<DeterministicMean>},
        {"float, sum", Format::binary32, run_mean<NaiveMean<float>>},
        {"float, running mean", Format::binary32, run_mean<RunningMean>},
        {"float, compensated sum", Format::binary32, run_mean<KahanMean>},
        {"double, sum", Format::binary64, run_mean<NaiveMean<double>>},
    };
    // The film: mean += (x - mean) / k rounds by u (|mean| + 3 |x - mean| / k) in step k, and later
    // steps keep (k / n) of it; |x| <= 1 and the mean is about 1/2 (at least 1/4 from 64 samples on, but
    // for a chance of 1e-13). Sum over k of (k / n) u (mean + 3 / k), over the mean: u (n / 2 + 12). A
    // batch of four adds 5 roundings of its format.
    const auto film_bound = [](double n) { return u64 * (n / samples_of_batch / 2 + 1 + 12 + 5); };
    const std::string because = "the film counts in double: its error grows by less than 2^-53 in each "
                                "batch, and nothing of it was seen up to here, the most that is tried";
    axis.limits = {
        {"ref", 0x1p26, film_bound, no_failure, Failure::inaccurate, because},
        {"host", 0x1p26, [=](double n) { return film_bound(n) + 5 * u32; }, no_failure,
         Failure::inaccurate, because + "; the four samples of a batch are summed in float"},
        // n - 1 additions, each rounds by u times a partial sum; the division is one more.
        {"host, one batch", 0x1p17, [](double n) { return n * u32; }, 0x1p26, Failure::inaccurate,
         "a sum of floats rounds by up to 2^-24 in each addition, and stops growing at 2^24 to 2^25: "
         "keep "
         "the batches of --batch below 131,072"},
        // Exact; its value and the division carry 12 roundings of doubles.
        {"host, deterministic", 0x1p26, [](double) { return 12 * u64; }, no_failure, Failure::inaccurate,
         "the sum of floats is exact, up to 2^32 terms"},
    };
    axis.derivation = "each step of the film rounds the mean once or more, by less than $u (m + 3/k)$ "
                      "in step $k$ for a "
                      "mean $m$, and later steps keep the share $k/n$ of it: in all $u (n/2 + 12)$ "
                      "after $n$ batches. A "
                      "plain sum of $n$ floats is within $n u$. The deterministic sum has no rounding.";
    return axis;
}

} // namespace extremes
