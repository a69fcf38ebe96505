#include "trade/study.h"

#include "images/png.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <numeric>
#include <random>

namespace trade {

namespace {

/// The seed of the renders of a round. With options.seed below 2^32 it is below 2^53, and not that of
/// goldens (cli/golden_render.h), with whose samples a picture must not be compared.
std::uint64_t seed_of(const StudyOptions& options, std::size_t round)
{
    constexpr std::uint64_t most_rounds = 1U << 20;
    return options.seed * most_rounds + round + 1;
}

/// The configurations in the order of a round. The same for every start of the study.
std::vector<std::size_t> order_of(const StudyOptions& options, std::size_t count, std::size_t round)
{
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937_64 random(seed_of(options, round));
    std::ranges::shuffle(order, random);
    return order;
}

std::string too_slow(double seconds)
{
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(),
                  "too slow: the fewest samples take about %.2g s a round; give it more --seconds",
                  seconds);
    return text.data();
}

/// One study in progress.
class InProgress {
public:
    InProgress(const std::vector<Configuration>& configurations, const StudyOptions& options,
               const Truth& truth, const Clock& clock, const StudyMonitor& monitor,
               std::vector<Measurements>& measured)
        : configurations_(configurations), options_(options), truth_(truth), clock_(clock),
          monitor_(monitor), measured_(measured)
    {}

    bool run()
    {
        measured_.resize(configurations_.size());
        for (std::size_t i = 0; i < configurations_.size(); ++i)
            if (!measured_[i].plan && measured_[i].problem.empty() && !plan(i)) return false;
        for (std::size_t round = 0; round < options_.rounds; ++round) {
            bool any = false;
            for (const std::size_t i : order_of(options_, configurations_.size(), round)) {
                if (!measured_[i].problem.empty() || measured_[i].rounds.size() > round) continue;
                if (!guarded(i, [&] { return measure_once(i, round); })) return false;
                any = true;
                report();
            }
            if (any && monitor_.keep) monitor_.keep();
        }
        return true;
    }

private:
    /// An error becomes the problem of the configuration. False if the study was stopped.
    template <class Work>
    bool guarded(std::size_t i, const Work& work)
    {
        try {
            return work();
        } catch (const std::exception& error) {
            measured_[i].problem = error.what();
            return true;
        }
    }

    bool plan(std::size_t i)
    {
        const double share = options_.seconds / static_cast<double>(options_.rounds) /
                             static_cast<double>(configurations_.size());
        return guarded(i, [&] {
            const double start = clock_().wall;
            const auto found =
                plan_for(share, configurations_[i].make, seed_of(options_, 0), clock_, monitor_.stop);
            if (!found) return false;
            // The search for the plan rendered two samples at least.
            const double fewest = (clock_().wall - start) / 2.0 * static_cast<double>(fewest_batches);
            if (found->batches == fewest_batches && found->batch_size == 1 &&
                fewest > 0.5 * options_.seconds)
                measured_[i].problem = too_slow(fewest);
            else
                measured_[i].plan = found;
            return true;
        });
    }

    bool measure_once(std::size_t i, std::size_t round)
    {
        Measurements& into = measured_[i];
        auto found = measure(configurations_[i].make, *into.plan, seed_of(options_, round), truth_,
                             clock_, monitor_.stop);
        if (!found) return false;
        into.rounds.push_back(std::move(found->round));
        if (round == 0) into.picture = images::encode_png(found->picture, options_.exposure);
        if (round < rounds_with_memory && configurations_[i].peak_bytes)
            if (const auto bytes = configurations_[i].peak_bytes()) into.peak_bytes.push_back(*bytes);
        return true;
    }

    void report() const
    {
        if (!monitor_.progress) return;
        double done = 0.0;
        double all = 0.0;
        for (const Measurements& of_one : measured_) {
            if (!of_one.problem.empty()) continue;
            done += static_cast<double>(of_one.rounds.size());
            all += static_cast<double>(options_.rounds);
        }
        monitor_.progress(all > 0.0 ? done / all : 1.0);
    }

    const std::vector<Configuration>& configurations_;
    const StudyOptions& options_;
    const Truth& truth_;
    const Clock& clock_;
    const StudyMonitor& monitor_;
    std::vector<Measurements>& measured_;
};

} // namespace

bool study(const std::vector<Configuration>& configurations, const StudyOptions& options,
           const Truth& truth, const Clock& clock, const StudyMonitor& monitor,
           std::vector<Measurements>& measured)
{
    return InProgress(configurations, options, truth, clock, monitor, measured).run();
}

} // namespace trade
