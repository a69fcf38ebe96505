// The mean of very many samples.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"
#include "extremes/sums/means.h"

#include <algorithm>
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
    // The film: a join m_a + (m_b - m_a) share rounds by at most u (|m| + 3 |m_b - m_a|), and averages
    // the errors of its halves; a batch takes part in at most 2 log2(n / 4) joins of batches of 4. |x|
    // <= 1, and the mean is about 1/2 (at least 1/4 from 64 samples on, but for a chance of 1e-13):
    // relative to it, 13 u in each join. A batch of four adds 5 roundings of its format.
    const auto film_bound = [](double n) {
        return u64 * (13 * 2 * std::log2(std::max(2.0, n / samples_of_batch)) + 5);
    };
    constexpr double tested = 0x1p22;
    const std::string because =
        "the film joins batches in pairs, in double: its error grows with the logarithm of their "
        "number; 2^32 samples are the most that are walked, and by this bound no number of samples that "
        "a counter of 64 bits holds has an error above 2e-13";
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
    axis.derivation =
        "a join of two blocks of the film, of means $m_a$ and $m_b$, rounds the mean by less "
        "than $u (m + 3 |m_b - m_a|)$ and averages the errors of its halves. A batch takes "
        "part in at most $2 \\log_2 B$ joins of $B$ batches: in all $26 u \\log_2 B$ of the "
        "mean for samples up to 1 and a mean above 1/4. A plain sum of $n$ floats is within "
        "$n u$. The deterministic sum has no rounding.";
    return axis;
}

} // namespace extremes
