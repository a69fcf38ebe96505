// Contributions that are not finite never reach a film, and their number does not depend on threads.

#include "cuda/launch/batch_renderer.h"
#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/film_sink.h"
#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A film of few pixels in the memory of the host.
struct SmallFilm {
    static constexpr std::uint32_t pixels = 4;
    std::vector<fast::Rgb> own = std::vector<fast::Rgb>(64, fast::Rgb(0.0f));
    std::vector<fast::Rgb> splats = std::vector<fast::Rgb>(pixels, fast::Rgb(0.0f));
    std::vector<fast::DroppedCount> dropped = std::vector<fast::DroppedCount>(1);
    fast::FilmTarget target{own, {splats, {}}, {}, dropped, false, pixels};
};

/// Kernel over samples: each adds a finite contribution, and one that is not finite, to its own pixel
/// and to another one.
struct AddToFilm {
    fast::FilmTarget target;
    void operator()(std::uint32_t i) const
    {
        const std::uint32_t pixel = 1 + i % 3;
        fast::FilmSink sink(target, pixel);
        sink.add(1, 2, fast::Rgb(1.0f, 2.0f, 3.0f), 0.5f);
        sink.add(2, 2, fast::Rgb(1.0f, i % 2 == 0 ? nan : infinity, 3.0f), 1.0f);
        sink.splat(pixel, 2, fast::Rgb(1.0f), 1.0f);
        sink.splat(pixel, 3, fast::Rgb(1.0f), nan);
        target.own[i] = sink.own();
    }
};

template <class Executor>
void expect_all_dropped(Executor& executor)
{
    SmallFilm film;
    executor(30, AddToFilm{film.target});
    for (std::uint32_t i = 0; i < 30; ++i) EXPECT_EQ(film.own[i], fast::Rgb(0.5f, 1.0f, 1.5f));
    for (std::uint32_t pixel = 1; pixel < 4; ++pixel) EXPECT_EQ(film.splats[pixel], fast::Rgb(10.0f));
    EXPECT_EQ(film.dropped[0].count, 60u);
    EXPECT_EQ(film.dropped[0].least_key, fast::dropped_key(1, 2, 2)); // before s = 3, t = 1
}

TEST(DroppedContributions, AreCountedAndLeftOutOneByOne)
{
    fast::SerialExecutor executor;
    expect_all_dropped(executor);
}

TEST(DroppedContributions, AreCountedAndLeftOutByManyThreads)
{
    fast::ThreadedExecutor executor(4);
    expect_all_dropped(executor);
}

TEST(DroppedContributions, NoneIsLostWhoeverComesBetween)
{
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        parallel_test::InterleavedExecutor executor(
            4, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(random()) % ready; });
        expect_all_dropped(executor);
    }
}

/// An executor on which each pixel of the first batch has a contribution of strategy (2, 3) that is not
/// finite. Later batches have none at all.
struct DroppingExecutor : fast::SerialExecutor {
    static void wait() {}
};

template <fast::Integrator integrator>
void launch_samples(DroppingExecutor& /*executor*/, fast::Needs /*needs*/,
                    const fast::SceneInMemory& /*scene*/, const fast::SampleJob& job)
{
    if (job.launch.first_sample > 0) return;
    for (std::uint32_t i = 0; i < job.launch.pixels; ++i)
        fast::FilmSink(job.film, job.launch.first_pixel + i).add(2, 3, fast::Rgb(nan), 1.0f);
}

TEST(DroppedContributions, AreReportedOnceWithThePlaceOfTheFirst)
{
    fast::HostMemory memory;
    DroppingExecutor executor;
    images::RenderOptions options;
    options.integrator = fast::Integrator::path;
    fast::BatchRenderer renderer(memory, executor, {8, 8, std::size_t{1} << 30},
                                 transport_test::our_scene("point_over_plane"), 4, 5, options, {});
    std::vector<images::Dropped> reports;
    images::Monitor monitor;
    monitor.dropped = [&](const images::Dropped& dropped) { reports.push_back(dropped); };
    for (const std::uint64_t number : {0, 1}) (void)renderer.render_batch(number, monitor);
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_EQ(reports[0].count, 20u);
    EXPECT_EQ(reports[0].pixel, 0u);
    EXPECT_EQ(reports[0].s, 2);
    EXPECT_EQ(reports[0].t, 3);
}

} // namespace
