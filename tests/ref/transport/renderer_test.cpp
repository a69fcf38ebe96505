#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"
#include "tests/ref/transport/changed_scene.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>

namespace {

using ref::Contribution;
using ref::Rgb;

constexpr int width = 37; // not a multiple of the tile size
constexpr int height = 21;

const scenes::Scene& scene()
{
    static const scenes::Scene loaded = transport_test::our_scene("cornell_glass");
    return loaded;
}

images::Film rendered(ref::Integrator integrator, std::uint64_t batches, unsigned threads,
                      images::Film film = {width, height})
{
    const ref::World world(scene(), width, height);
    EXPECT_TRUE(images::fill(film, batches,
                             *ref::renderer(world, integrator, {.seed = 11, .batch_size = 2}, threads)));
    return film;
}

/// Like a light walk: splats on pixels far from the sample's own, with sums that depend on their
/// order.
void splash(const ref::World& world, const ref::PathOptions& /*options*/, const ref::SampleId& id,
            std::vector<Contribution>& out)
{
    const auto u = ref::uniforms(id, ref::Event::camera);
    const auto pixels = static_cast<double>(world.camera.width() * world.camera.height());
    for (const double v : u)
        out.push_back({static_cast<std::uint32_t>(v * pixels), 2, 1, Rgb(v * 1e-8, 1.0 / v, v), u[0]});
    out.push_back({id.pixel, 0, 2, Rgb(u[1]), 1.0});
}

TEST(Render, DoesNotDependOnTheNumberOfThreads)
{
    for (const auto integrator : {ref::trace_path, splash}) {
        const images::Film one = rendered(integrator, 3, 1);
        EXPECT_EQ(one, rendered(integrator, 3, 2));
        EXPECT_EQ(one, rendered(integrator, 3, 7));
    }
}

// Every triangle of the room twice, the copies in red and in reverse order: each ray that hits a wall
// has two closest hits, and the picture shows which one was chosen.
TEST(Render, DoesNotDependOnTheBuilderOfTheTreeEvenWhereTwoHitsAreEquallyFar)
{
    scenes::Scene doubled = scene();
    const auto red = static_cast<std::uint32_t>(doubled.materials.size());
    doubled.materials.emplace_back(scenes::Lambertian{Rgb(0.9, 0.1, 0.1)});
    for (std::size_t i = scene().triangles.size(); i-- > 0;)
        doubled.triangles.push_back({scene().triangles[i].vertices, red});
    const auto rendered_by = [&](const ref::BuildOptions& builder, ref::Integrator integrator) {
        const ref::World world(doubled, width, height, builder);
        images::Film film(width, height);
        EXPECT_TRUE(
            images::fill(film, 2, *ref::renderer(world, integrator, {.seed = 11, .batch_size = 2}, 2)));
        return film;
    };
    for (const auto integrator : {ref::trace_path, ref::trace_bidirectionally}) {
        const images::Film expected = rendered_by(ref::Builder::sah_leaf, integrator);
        for (const auto builder : {ref::Builder::morton30, ref::Builder::morton63, ref::Builder::sah})
            EXPECT_EQ(expected, rendered_by(builder, integrator));
        for (const std::size_t leaf_size : {1u, 2u, 16u})
            EXPECT_EQ(expected, rendered_by({ref::Builder::sah_leaf, leaf_size}, integrator));
    }
}

TEST(Render, GoesOnFromAnEarlierFilmAsIfNeverInterrupted)
{
    for (const auto integrator : {ref::trace_path, splash})
        EXPECT_EQ(rendered(integrator, 7, 2), rendered(integrator, 7, 2, rendered(integrator, 3, 2)));
}

TEST(Render, StopsSoonWithWholeBatchesOnly)
{
    const images::Film whole = rendered(splash, 5, 1);
    const ref::World world(scene(), width, height);
    for (const int limit : {1, 7, 20}) {
        images::Film film(width, height);
        std::atomic<int> asked = 0;
        const images::Monitor monitor{{}, [&] { return ++asked > limit; }};
        EXPECT_FALSE(images::fill(
            film, 5, *ref::renderer(world, splash, {.seed = 11, .batch_size = 2}, 2), monitor));
        EXPECT_LT(film.batches(), 5u);
        EXPECT_LE(asked, limit + 2); // each of two threads asks at most once more
        EXPECT_EQ(rendered(splash, 5, 2, film), whole);
    }
}

TEST(Render, SaysHowFarItIs)
{
    const ref::World world(scene(), width, height);
    images::Film film(width, height);
    double last = 0.0;
    EXPECT_TRUE(images::fill(film, 3, *ref::renderer(world, splash, {.batch_size = 2}, 2),
                             {[&](double done) {
                                  EXPECT_GT(done, last);
                                  last = done;
                              },
                              {}}));
    EXPECT_EQ(last, 3.0);
}

TEST(Render, ShowsTheFilmAfterEachBatch)
{
    const ref::World world(scene(), width, height);
    images::Film film(width, height);
    std::vector<images::Film> seen;
    EXPECT_TRUE(images::fill(film, 3, *ref::renderer(world, splash, {.seed = 11, .batch_size = 2}, 2),
                             {}, [&](const images::Batch& /*batch*/) { seen.push_back(film); }));
    ASSERT_EQ(seen.size(), 3u);
    EXPECT_EQ(seen[0], rendered(splash, 1, 1));
    EXPECT_EQ(seen[2], film);
}

// The splats of one walk are divided by the samples per pixel, once.
TEST(Render, ASplatCountsOnceAndIsDividedBySamplesPerPixel) // map: splat
{
    const auto one_each = [](const ref::World& /*world*/, const ref::PathOptions& /*options*/,
                             const ref::SampleId& id, std::vector<Contribution>& out) {
        out.push_back({(id.pixel + 100) % (width * height), 2, 1, Rgb(1.0, 2.0, 4.0), 0.5});
    };
    const images::Film film = rendered(one_each, 2, 2);
    for (const images::Image mean = film.mean(); const Rgb& pixel : mean.pixels)
        ASSERT_EQ(pixel, Rgb(0.5, 1.0, 2.0));
}

// Batch n draws the samples n B ... n B + B - 1 of every pixel: none twice, none left out. Batches that
// share samples make the same picture on average, but their error tells less than the truth. Four whole
// numbers whose sum is 6 and whose squares add up to 14 can only be 0, 1, 2, 3.
TEST(Render, DrawsEverySampleOfAPixelOnce)
{
    const auto its_number = [](const ref::World& /*world*/, const ref::PathOptions& /*options*/,
                               const ref::SampleId& id, std::vector<Contribution>& out) {
        const double number = id.sample;
        out.push_back({id.pixel, 0, 2, Rgb(number, number * number, 1.0), 1.0});
    };
    const images::Film film = rendered(its_number, 2, 2);
    for (const images::Image mean = film.mean(); const Rgb& pixel : mean.pixels)
        ASSERT_EQ(pixel, Rgb(6.0 / 4.0, 14.0 / 4.0, 1.0));
}

/// One finite contribution; and for every third pixel one that is not finite, to its own pixel or as a
/// splat.
void sometimes_not_finite(const ref::World& /*world*/, const ref::PathOptions& /*options*/,
                          const ref::SampleId& id, std::vector<Contribution>& out)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    out.push_back({id.pixel, 0, 2, Rgb(1.0), 1.0});
    if (id.pixel % 3 != 1) return;
    if (id.pixel % 2 == 0)
        out.push_back({id.pixel, 1, 2, Rgb(1.0, infinity, 1.0), 0.5});
    else
        out.push_back({id.pixel, 2, 1, Rgb(1.0), nan});
}

TEST(Render, LeavesOutWhatIsNotFiniteAndSaysHowMuch)
{
    const ref::World world(scene(), width, height);
    for (const unsigned threads : {1u, 4u}) {
        images::Film film(width, height);
        images::StrategySums strategies;
        images::Dropped dropped;
        int reports = 0;
        images::Monitor monitor;
        monitor.dropped = [&](const images::Dropped& of_batch) {
            dropped += of_batch;
            ++reports;
        };
        const auto renderer = ref::renderer(world, sometimes_not_finite,
                                            {.seed = 1,
                                             .max_edges = 3,
                                             .batch_size = 2,
                                             .strategies = images::StrategyPictures::unweighted},
                                            threads);
        ASSERT_TRUE(images::fill(film, 3, *renderer, monitor,
                                 [&](const images::Batch& batch) { strategies.add(batch.strategies); }));
        for (const images::Image mean = film.mean(); const Rgb& pixel : mean.pixels)
            ASSERT_EQ(pixel, Rgb(1.0));
        EXPECT_EQ(strategies.means(2).size(),
                  1u); // only (0, 2): the others have no finite contribution
        EXPECT_EQ(reports, 3);
        EXPECT_EQ(dropped.count, 3u * 2u * (width * height / 3));
        EXPECT_EQ(
            images::describe(dropped, width).substr(5),
            "contribution(s) are not finite and were left out, the first at pixel (1, 0) by strategy "
            "s2t1")
            << images::describe(dropped, width);
    }
}

TEST(Render, NeverLeavesOutWhatIsNotFiniteWithoutAWord)
{
    const ref::World world(scene(), width, height);
    EXPECT_THROW(
        ref::renderer(world, sometimes_not_finite, {.seed = 1, .batch_size = 2}, 2)->render_batch(0),
        std::runtime_error);
}

TEST(Render, RefusesAWorldOfWhichProductsOfLengthsOverflow)
{
    for (const double factor : {1e110, 1e-110})
        EXPECT_THROW(ref::World(transport_test::scaled(scene(), factor), width, height),
                     std::invalid_argument);
    EXPECT_NO_THROW(ref::World(transport_test::scaled(scene(), 1e90), width, height));
}

TEST(Render, PassesOnWhatAnIntegratorThrows)
{
    const auto broken = [](const ref::World& /*world*/, const ref::PathOptions& /*options*/,
                           const ref::SampleId& /*id*/,
                           std::vector<Contribution>& /*out*/) { throw std::runtime_error("broken"); };
    const ref::World world(scene(), width, height);
    images::Film film(width, height);
    EXPECT_THROW(images::fill(film, 3, *ref::renderer(world, broken, {.batch_size = 2}, 2)),
                 std::runtime_error);
    EXPECT_EQ(film.batches(), 0u);
}

std::atomic<bool> thread_has_ended = false;

struct SetsItAtTheEnd {
    ~SetsItAtTheEnd() { thread_has_ended = true; }
};

TEST(Render, StopsTheOtherThreadsWhereAnIntegratorThrows)
{
    static std::atomic<int> samples = 0;
    static const std::thread::id this_one = std::this_thread::get_id();
    thread_has_ended = false;
    // The second thread throws in its first sample. This one waits for its end, and so finds the error.
    const auto broken = [](const ref::World& /*world*/, const ref::PathOptions& /*options*/,
                           const ref::SampleId& /*id*/, std::vector<Contribution>& /*out*/) {
        if (std::this_thread::get_id() != this_one) {
            thread_local const SetsItAtTheEnd end;
            static_cast<void>(end);
            throw std::runtime_error("broken");
        }
        ++samples;
        while (!thread_has_ended) std::this_thread::yield();
    };
    const ref::World world(scene(), width, height);
    images::Film film(width, height);
    EXPECT_THROW(images::fill(film, 1, *ref::renderer(world, broken, {.batch_size = 1}, 2)),
                 std::runtime_error);
    EXPECT_LE(samples, 16 * 16); // the rest of the tile that it had begun
}

TEST(Render, RefusesAFilmOfAnotherSize)
{
    const ref::World world(scene(), width, height);
    images::Film film(height, width);
    EXPECT_THROW(images::fill(film, 64, *ref::renderer(world, splash, {})), std::invalid_argument);
}

// Samples are independent: another number of samples, another pixel or another order cannot change the
// contributions of a given sample of a given pixel.
RC_GTEST_PROP(Render, ASampleCanBeComputedAlone, (std::uint64_t seed))
{
    const ref::World world(scene(), width, height);
    const auto pixel = *rc::gen::inRange(0u, static_cast<std::uint32_t>(width * height));
    const auto sample = *rc::gen::inRange(0u, 1000u);
    std::vector<Contribution> a;
    std::vector<Contribution> b;
    ref::trace_path(world, {.seed = seed}, {seed, pixel, sample}, a);
    ref::trace_path(world, {.seed = seed}, {seed, (pixel + 1) % (width * height), sample}, b);
    b.clear();
    ref::trace_path(world, {.seed = seed}, {seed, pixel, sample}, b);
    RC_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        RC_ASSERT(a[i].value == b[i].value && a[i].weight == b[i].weight);
}

} // namespace
