// Splats from many threads at once: none is lost, in any schedule.

#include "cuda/launch/host_kernels.h"
#include "cuda/transport/film_sink.h"
#include "tests/cuda/parallel/interleaved_executor.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <random>
#include <vector>

namespace {

constexpr std::size_t pixels = 3; // few, so that threads collide often

/// Kernel over splats.
struct AddSplats {
    std::span<const float> values;
    fast::SplatTarget target;
    void operator()(std::uint32_t i) const { target.add(i % pixels, fast::Rgb(values[i])); }
};

/// The same with a sum that is read and written in two steps.
struct AddTornSplats {
    std::span<const float> values;
    std::span<fast::Rgb> sums;
    void operator()(std::uint32_t i) const
    {
        const fast::Rgb before = sums[i % pixels];
        if (fast::schedule_point != nullptr) fast::schedule_point();
        sums[i % pixels] = before + fast::Rgb(values[i]);
    }
};

std::vector<float> some_values(std::uint32_t seed, std::size_t count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> exponent(-20, 20);
    std::vector<float> values(count);
    for (float& value : values) value = std::exp2(exponent(random));
    return values;
}

double expected(const std::vector<float>& values, std::size_t pixel)
{
    double sum = 0;
    for (std::size_t i = pixel; i < values.size(); i += pixels) sum += values[i];
    return sum;
}

/// Whether the sums are correct for floats: every addition of terms >= 0 has an error of at most 2^-24
/// of the sum.
bool hold(const std::vector<fast::Rgb>& sums, const std::vector<float>& values)
{
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const double sum = expected(values, pixel);
        const double bound = 0x1p-24 * sum * static_cast<double>(values.size() / pixels + 1);
        for (int channel = 0; channel < 3; ++channel)
            if (std::abs(sums[pixel][channel] - sum) > bound) return false;
    }
    return true;
}

template <class Executor>
void expect_all_there(Executor& executor, const std::vector<float>& values)
{
    const auto count = static_cast<std::uint32_t>(values.size());
    std::vector<fast::Rgb> sums(pixels, fast::Rgb(0.0f));
    executor(count, AddSplats{values, {sums, {}}});
    RC_ASSERT(hold(sums, values));

    std::vector<fast::ExactSum> exact(3 * pixels);
    std::vector<fast::ExactSum> in_order(3 * pixels);
    executor(count, AddSplats{values, {{}, exact}});
    fast::SerialExecutor{}(count, AddSplats{values, {{}, in_order}});
    for (std::size_t i = 0; i < exact.size(); ++i) RC_ASSERT(exact[i].value() == in_order[i].value());
}

RC_GTEST_PROP(Splats, AreAllThereInEveryOrderOfAtomicSteps, ()) // map: splat
{
    std::mt19937 chooser(*rc::gen::arbitrary<std::uint32_t>());
    parallel_test::InterleavedExecutor executor(
        4, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(chooser() % ready); });
    expect_all_there(executor, some_values(1, *rc::gen::inRange<std::size_t>(0, 40)));
}

RC_GTEST_PROP(Splats, AreAllThereFromRealThreads, ())
{
    fast::ThreadedExecutor executor(*rc::gen::inRange(1u, 5u), 1);
    expect_all_there(executor, some_values(2, *rc::gen::inRange<std::size_t>(0, 3000)));
}

/// Kernel over threads: each adds its share of the splats, to its copy if there is one for each.
struct AddShareOfSplats {
    std::span<const float> values;
    fast::SplatTarget target;
    std::uint32_t threads;
    void operator()(std::uint32_t thread) const
    {
        const AddSplats add{values, target.of_thread(thread, threads)};
        for (std::uint32_t i = thread; i < values.size(); i += threads) add(i);
    }
};

RC_GTEST_PROP(Splats, AreAllThereFromThreadsWithACopyEach, ())
{
    const auto threads = *rc::gen::inRange(1u, 5u);
    const auto copies = *rc::gen::element(std::size_t{1}, std::size_t{threads});
    const std::vector<float> values = some_values(4, *rc::gen::inRange<std::size_t>(0, 3000));
    std::vector<fast::Rgb> sums(copies * pixels, fast::Rgb(0.0f));
    fast::ThreadedExecutor executor(threads, 1);
    executor(threads, AddShareOfSplats{values, {sums, {}, copies}, threads});
    // A copy has the splats of its thread and no others.
    for (std::size_t copy = 0; copy < copies; ++copy) {
        std::vector<float> own(values.size(), 0.0f);
        for (std::size_t i = 0; i < values.size(); ++i)
            if (copies == 1 || i % threads == copy) own[i] = values[i];
        const auto first = sums.begin() + static_cast<std::ptrdiff_t>(copy * pixels);
        RC_ASSERT(hold({first, first + pixels}, own));
    }
}

TEST(Splats, HaveACopyForEachThreadUnlessThatIsTooMuchMemory)
{
    const fast::HostThreads threads(3);
    EXPECT_EQ(splat_copies(threads, 1000), 3);
    EXPECT_EQ(splat_copies(threads, std::size_t{1} << 28), 1);
    EXPECT_EQ(splat_copies(fast::SerialExecutor(), 1000), 1); // of whole samples
}

// Otherwise the tests of all orders would prove nothing.
TEST(Splats, ThatAreTornAreFound)
{
    const std::vector<float> values = some_values(3, 32);
    int found = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 chooser(seed);
        parallel_test::InterleavedExecutor executor(
            4, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(chooser() % ready); });
        std::vector<fast::Rgb> sums(pixels, fast::Rgb(0.0f));
        executor(32, AddTornSplats{values, sums});
        if (!hold(sums, values)) ++found;
    }
    EXPECT_EQ(found, 20);
}

} // namespace
