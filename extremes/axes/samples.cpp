// The mean of very many samples.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"
#include "extremes/sums/means.h"

#include <cmath>

namespace extremes {

namespace {

/// Uniform on [0, 1), in units of 2^-24, so that each is a float and sums of 2^40 of them are integers
/// of 64 bits. Two from each number that is drawn.
class SampleStream {
public:
    explicit SampleStream(Random& random) : random_(&random) {}
    std::uint64_t next()
    {
        low_next_ = !low_next_;
        if (low_next_) bits_ = random_->bits();
        return low_next_ ? bits_ >> 40 : bits_ >> 16 & 0xff'ffff;
    }

private:
    Random* random_;
    std::uint64_t bits_ = 0;
    bool low_next_ = false;
};

/// A method: Mean has add(float) and mean(count).
template <class Mean>
void run_mean(double parameter, Random& random, int cases, Tally& tally)
{
    auto count = static_cast<std::uint64_t>(parameter);
    if (count > samples_of_batch) count -= count % samples_of_batch; // whole batches
    for (int i = 0; i < cases; ++i) {
        Mean mean;
        SampleStream samples(random);
        std::uint64_t sum = 0;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::uint64_t units = samples.next();
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

} // namespace

Axis samples_axis()
{
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
    axis.values.push_back(0x1p32);
    axis.most_cases = 1;
    axis.methods = {
        {"ref", Format::binary64, run_mean<FilmMean<double, samples_of_batch>>},
        {"host", Format::binary32, run_mean<FilmMean<float, samples_of_batch>>},
        {"host, one batch", Format::binary32, run_mean<FilmMean<float, one_batch>>},
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
    constexpr double tested = 0x1p22;
    const std::string because =
        "the film counts in double: its error grows by less than 2^-53 in each batch; 2^32 samples are "
        "the most that are walked, and by this bound 10^13 samples are within 1%";
    axis.limits = {
        {"ref", 0x1p32, film_bound, no_failure, Failure::inaccurate, because, tested},
        {"host", 0x1p32, [=](double n) { return film_bound(n) + 5 * u32; }, no_failure,
         Failure::inaccurate, because + "; the four samples of a batch are summed in float", tested},
        // n - 1 additions, each rounds by u times a partial sum; the division is one more.
        {"host, one batch", 0x1p17, [](double n) { return n * u32; }, 0x1p26, Failure::inaccurate,
         "a sum of floats rounds by up to 2^-24 in each addition, and stops growing at 2^24 to 2^25: "
         "keep the batches of --batch below 131,072"},
        // Exact; its value and the division carry 12 roundings of doubles.
        {"host, deterministic", 0x1p32, [](double) { return 12 * u64; }, no_failure, Failure::inaccurate,
         "the sum of floats is exact, up to 2^32 terms (beyond: axis equal-samples)", tested},
    };
    axis.derivation = "each step of the film rounds the mean once or more, by less than $u (m + 3/k)$ "
                      "in step $k$ for a "
                      "mean $m$, and later steps keep the share $k/n$ of it: in all $u (n/2 + 12)$ "
                      "after $n$ batches. A "
                      "plain sum of $n$ floats is within $n u$. The deterministic sum has no rounding.";
    return axis;
}

} // namespace extremes
