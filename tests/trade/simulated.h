#pragma once

// Simulated configurations with known bias, noise and speed, and a clock that they advance: what the
// measurements of trade/ must find.

#include "golden/golden.h"
#include "trade/round.h"
#include "trade/truth.h"

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace trade_test {

constexpr int side = 8; // width and height in pixels

/// Gamma-distributed samples: relative variance `variance`, mean (1 + bias) times the truth.
struct Simulated {
    double bias = 0.0;
    double variance = 1.0;
    double seconds_per_sample = 1e-3; // per sample per pixel
    double build = 1e-2;              // seconds
    double cold = 0.0;                // seconds that the first batch on the machine takes in addition
};

/// Brightness of the true picture: from 1 to 2, different in each channel.
inline images::Rgb true_pixel(std::size_t i)
{
    const double x = static_cast<double>(i) / (side * side - 1);
    return {1.0 + x, 2.0 - x, 1.5};
}

/// The load of the machine: slows a round, and each measurement by itself.
struct Machine {
    std::mt19937_64 random;
    double own_scatter = 0.05; // relative standard deviation of single measurements
    double of_round = 1.0;     // factor on all times of the present round
    trade::Seconds now{};
    bool cold = true; // nothing was rendered yet

    void pass(double seconds)
    {
        now.wall += seconds;
        now.cpu += seconds;
    }
    double factor() { return of_round * std::exp(own_scatter * std::normal_distribution<>()(random)); }
};

class SimulatedRenderer : public images::Renderer {
public:
    SimulatedRenderer(const Simulated& what, std::uint32_t batch_size, Machine& machine)
        : what_(what), batch_size_(batch_size), machine_(machine), factor_(machine.factor())
    {
        machine.pass(what.build * machine.factor());
    }

private:
    std::optional<images::Batch> make_batch(std::uint64_t /*number*/,
                                            const images::Monitor& monitor) override
    {
        if (monitor.stop && monitor.stop()) return std::nullopt;
        machine_.pass(what_.seconds_per_sample * batch_size_ * factor_);
        if (std::exchange(machine_.cold, false)) machine_.pass(what_.cold);
        // The mean of n gamma variates of relative variance v is one of relative variance v / n.
        const double shape = batch_size_ / what_.variance;
        std::gamma_distribution<> gamma(shape, 1.0 / shape);
        images::Batch batch{images::Image(side, side), {}, {}};
        for (std::size_t i = 0; i < batch.mean.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                batch.mean.pixels[i][c] = true_pixel(i)[c] * (1.0 + what_.bias) * gamma(machine_.random);
        return batch;
    }

    Simulated what_;
    std::uint32_t batch_size_;
    Machine& machine_;
    double factor_; // the whole measurement is slower or faster
};

inline trade::MakeRenderer make(const Simulated& what, Machine& machine)
{
    return [&machine, what](std::uint32_t batch_size, std::uint64_t /*seed*/) {
        return std::make_unique<SimulatedRenderer>(what, batch_size, machine);
    };
}

inline trade::Clock clock_of(const Machine& machine)
{
    return [&machine] { return machine.now; };
}

/// A truth of 16 batches for regions and 64 to compare with, of `samples` samples per pixel each.
inline trade::Truth simulated_truth(Machine& machine, std::uint32_t samples)
{
    golden::GoldenMaker maker(side, side, 16);
    SimulatedRenderer renderer({}, samples, machine);
    for (std::uint64_t b = 0; b < 80; ++b) maker.add_batch(renderer.render_batch(b)->mean);
    return trade::Truth(maker.golden({}));
}

/// The relMSE of a relative error of 1 everywhere.
inline double relative_square(const trade::Truth& truth)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < side * side; ++i)
        for (int c = 0; c < 3; ++c) {
            const double t = true_pixel(i)[c];
            sum += truth.weights().pixels[i][c] * t * t / (3.0 * side * side);
        }
    return sum;
}

/// Measures each configuration in every round.
inline std::vector<std::vector<trade::Round>> measured(const std::vector<Simulated>& what,
                                                       std::size_t rounds, const trade::Plan& plan,
                                                       const trade::Truth& truth, Machine& machine)
{
    std::vector<std::vector<trade::Round>> all(what.size());
    for (std::size_t r = 0; r < rounds; ++r) {
        machine.of_round = std::exp(0.3 * std::normal_distribution<>()(machine.random));
        for (std::size_t i = 0; i < what.size(); ++i)
            all[i].push_back(
                trade::measure(make(what[i], machine), plan, r, truth, clock_of(machine), {})->round);
    }
    machine.of_round = 1.0;
    return all;
}

} // namespace trade_test
