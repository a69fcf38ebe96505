#include "cli/repetitions.h"

#include <cmath>
#include <cstdint>

namespace cli {

namespace {

constexpr std::uint32_t most_times = 1 << 20; // if the clock stands still

/// Mean and scatter of numbers that come one by one [Welford 1962].
class Mean {
public:
    void add(double value)
    {
        ++count_;
        const double before = value - mean_;
        mean_ += before / count_;
        squares_ += before * (value - mean_);
    }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] double value() const { return mean_; }
    /// Of the mean, relative to it: infinite for fewer than two numbers, or if the mean is zero.
    [[nodiscard]] double relative_standard_error() const
    {
        if (count_ < 2 || !(mean_ > 0)) return HUGE_VAL;
        return std::sqrt(squares_ / (count_ - 1) / count_) / mean_;
    }

private:
    int count_ = 0;
    double mean_ = 0;
    double squares_ = 0;
};

} // namespace

Repetitions repeat_until_precise(const std::function<double()>& now, const std::function<void()>& work,
                                 const Precision& precision)
{
    const auto seconds_of = [&](std::uint32_t times) {
        const double start = now();
        for (std::uint32_t i = 0; i < times; ++i) work();
        return now() - start;
    };
    std::uint32_t times = 1;
    while (seconds_of(times) < precision.shortest && times < most_times) times *= 2;

    Mean mean;
    double total = 0;
    const auto goes_on = [&] {
        if (mean.count() < 2) return true;
        if (total >= precision.most_seconds) return false;
        return mean.count() < precision.fewest || !(mean.relative_standard_error() < precision.relative);
    };
    // A clock that stands still gives no mean, and would never reach the most seconds either.
    while (goes_on() && (total > 0 || mean.count() < precision.fewest)) {
        const double seconds = seconds_of(times);
        total += seconds;
        mean.add(seconds / times);
    }
    return {mean.value(), mean.relative_standard_error(), mean.count()};
}

} // namespace cli
