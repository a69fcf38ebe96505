#include "extremes/walk.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

namespace extremes {

namespace {

constexpr int cases_of_chunk = 250;

/// A number that looks random for each pair (a, b): the finalizer of SplitMix64 [Steele, Lea and Flood
/// 2014].
std::uint64_t mixed(std::uint64_t a, std::uint64_t b)
{
    std::uint64_t z = a + (b + 1) * 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

} // namespace

std::optional<std::vector<Tally>> visit(const Axis& axis, std::span<const Method* const> methods,
                                        double parameter, const WalkOptions& options)
{
    const int cases = std::min(options.cases, axis.most_cases);
    const int chunks = (cases + cases_of_chunk - 1) / cases_of_chunk;
    const std::uint64_t seed = mixed(mixed(options.seed, static_cast<std::uint64_t>(axis.number)),
                                     std::bit_cast<std::uint64_t>(parameter));
    std::vector<std::vector<Tally>> tallies(static_cast<std::size_t>(chunks),
                                            std::vector<Tally>(methods.size()));
    std::atomic<int> next = 0;
    std::atomic<bool> stopped = false;
    std::mutex mutex; // of stop() and of `thrown`
    std::exception_ptr thrown;
    const auto work = [&] {
        for (;;) {
            {
                const std::lock_guard lock(mutex);
                if (options.stop()) stopped = true;
            }
            if (stopped) return;
            const int chunk = next++;
            if (chunk >= chunks) return;
            try {
                for (std::size_t i = 0; i < methods.size(); ++i) {
                    Random random(mixed(seed, static_cast<std::uint64_t>(chunk)));
                    methods[i]->run(parameter, random,
                                    std::min(cases_of_chunk, cases - chunk * cases_of_chunk),
                                    tallies[static_cast<std::size_t>(chunk)][i]);
                }
            } catch (...) {
                const std::lock_guard lock(mutex);
                thrown = std::current_exception();
                stopped = true;
            }
        }
    };
    {
        std::vector<std::jthread> others;
        const int count = std::min(static_cast<int>(options.threads), chunks);
        for (int i = 1; i < count; ++i) others.emplace_back(work);
        work();
    }
    if (thrown) std::rethrow_exception(thrown);
    if (stopped) return std::nullopt;
    std::vector<Tally> sums(methods.size());
    for (const std::vector<Tally>& chunk : tallies)
        for (std::size_t i = 0; i < methods.size(); ++i) sums[i] += chunk[i];
    return sums;
}

std::optional<Tally> visit(const Axis& axis, const Method& method, double parameter,
                           const WalkOptions& options)
{
    const Method* const one = &method;
    const auto tallies = visit(axis, std::span(&one, 1), parameter, options);
    return tallies ? std::optional(tallies->front()) : std::nullopt;
}

std::vector<double> powers_of_ten(double from, double to, double step)
{
    std::vector<double> values;
    const auto steps = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i <= steps; ++i) values.push_back(std::pow(10.0, from + i * step));
    return values;
}

} // namespace extremes
