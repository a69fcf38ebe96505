#include "trade/round.h"

#include "images/film.h"
#include "trade/relative_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

namespace trade {

namespace {

Seconds between(const Seconds& start, const Seconds& end)
{
    return {end.wall - start.wall, end.cpu - start.cpu};
}

void add(Seconds& sum, const Seconds& part)
{
    sum.wall += part.wall;
    sum.cpu += part.cpu;
}

/// The relMSE of one sample per pixel as each batch estimates it. With x_b a batch of n samples per
/// pixel and m the mean of all B, the expectation of (x_b - m)^2 is (1 - 1/B) v / n, v the variance of
/// one sample.
golden::Moments noise_of(const std::vector<images::Image>& batches, std::uint32_t batch_size,
                         const images::Image& mean, const Truth& truth)
{
    const auto count = static_cast<double>(batches.size());
    std::vector<double> estimates;
    estimates.reserve(batches.size());
    for (const images::Image& batch : batches)
        estimates.push_back(weighted_square(truth.weights(), batch, mean) * batch_size * count /
                            (count - 1.0));
    return golden::moments(estimates);
}

/// The mean over pixels and channels of w [(m - T)^2 - s^2 - s_T^2]: of the squared difference the
/// variances of both means are taken away.
double squared_bias(const images::Image& mean, const images::Image& standard_error, const Truth& truth)
{
    const images::Image zero(mean.width, mean.height);
    return weighted_square(truth.weights(), mean, truth.mean()) -
           weighted_square(truth.weights(), standard_error, zero) - truth.own_error();
}

} // namespace

Seconds process_clock()
{
    timespec cpu{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double>(wall).count(),
            static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

std::optional<Plan> plan_for(double seconds, const MakeRenderer& make, std::uint64_t seed,
                             const Clock& clock, const std::function<bool()>& stop)
{
    const double start = clock().wall;
    // The first batch of all, which is not measured, may take many times as long as the next ones: its
    // code and its memory are touched for the first time.
    if (!make(1, seed)->render_batch(0, {{}, stop})) return std::nullopt;
    // Batches of 1, 2, 4, ... samples, so that a device that is slow at small batches is planned by its
    // speed at large ones.
    double per_sample = 0.0;
    constexpr std::uint32_t largest = 1U << 20;
    for (std::uint32_t batch_size = 1; batch_size <= largest; batch_size *= 2) {
        const auto renderer = make(batch_size, seed);
        const double before = clock().wall;
        if (!renderer->render_batch(0, {{}, stop})) return std::nullopt;
        const double now = clock().wall;
        per_sample = (now - before) / batch_size;
        if (now - start > 0.25 * seconds || now - before > 0.1 * seconds) break;
    }
    const double samples = std::max(1.0, seconds / std::max(per_sample, 1e-12));
    Plan plan;
    plan.batch_size = static_cast<std::uint32_t>(
        std::clamp(samples / most_batches, 1.0, static_cast<double>(largest)));
    plan.batches = std::clamp(static_cast<std::uint64_t>(std::min(samples / plan.batch_size, 1e6)),
                              fewest_batches, most_batches * 2);
    return plan;
}

std::optional<MeasuredRound> measure(const MakeRenderer& make, const Plan& plan, std::uint64_t seed,
                                     const Truth& truth, const Clock& clock,
                                     const std::function<bool()>& stop)
{
    Round round;
    round.plan = plan;
    Seconds before = clock();
    const auto renderer = make(plan.batch_size, seed);
    round.build = between(before, clock());

    std::vector<images::Image> batches;
    images::Film film(truth.mean().width, truth.mean().height);
    std::vector<std::vector<double>> brightness(truth.regions().size());
    for (std::uint64_t number = 0; number < plan.batches; ++number) {
        before = clock();
        std::optional<images::Batch> batch = renderer->render_batch(number, {{}, stop});
        add(round.render, between(before, clock()));
        if (!batch) return std::nullopt;
        film.add_batch(batch->mean);
        const std::vector<double> values = truth.brightness(batch->mean);
        for (std::size_t r = 0; r < values.size(); ++r) brightness[r].push_back(values[r]);
        batches.push_back(std::move(batch->mean));
    }
    for (const std::vector<double>& values : brightness)
        round.brightness.push_back(golden::moments(values));
    images::BatchMoments moments = film.moments();
    round.noise = noise_of(batches, plan.batch_size, moments.mean, truth);
    round.bias_squared =
        squared_bias(moments.mean, images::standard_error(moments, film.batches()), truth);
    return MeasuredRound{std::move(round), std::move(moments.mean)};
}

} // namespace trade
