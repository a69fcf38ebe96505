// A picture from another renderer: CBspheres_lambertian.dae by pbrt, with its standard errors.

#include "images/pfm.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

using transport_test::Region;

/// Standard error of a region's mean, from those of its independent pixels.
double standard_error_over(const images::Image& errors, const Region& region, int channel)
{
    double sum = 0.0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
            const double e = errors.pixels[static_cast<std::size_t>(y * errors.width + x)][channel];
            sum += e * e;
        }
    return std::sqrt(sum) / ((region.x1 - region.x0) * (region.y1 - region.y0));
}

class CourseScene : public transport_test::OfEveryIntegrator {};
INSTANTIATE_TEST_SUITE_P(Integrators, CourseScene, transport_test::integrators(),
                         transport_test::name_of);

TEST_P(CourseScene, AgreesTileByTileWithAnotherRenderersPicture)
{
    const auto scene_path = transport_test::shared_file("scenes/CBspheres_lambertian.dae");
    const auto picture_path = transport_test::shared_file("pbrt/CBspheres_lambertian_a6.pfm");
    if (!std::filesystem::exists(scene_path) || !std::filesystem::exists(picture_path))
        GTEST_SKIP() << "the course's scenes and pbrt's picture are not available: " << scene_path;
    const images::Image theirs = images::read_pfm(picture_path);
    const images::Image their_errors =
        images::read_pfm(transport_test::shared_file("pbrt/CBspheres_lambertian_a6_se.pfm"));

    const scenes::Scene scene = scenes::read_scene(scene_path);
    const ref::World world(scene, theirs.width, theirs.height);
    // Our errors are computed from batches and not from pixels: if one light walk is seen in several
    // pixels, these are not independent.
    constexpr int samples = 48; // per pixel, and batches
    const transport_test::Batches ours = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = samples, .batch_size = 1, .path = {.seed = 1, .max_edges = 6}});

    // Student's quantiles, at a level of 1e-6 over all 1800 tiles and channels together, and the same
    // over the 3 channels of the whole picture. The errors of pbrt come from far more samples; taking
    // only ours gives too few degrees of freedom rather than too many.
    const double limit_of_tiles = transport_test::t_quantile(samples - 1.0, 1e-6 / 1800 / 2);
    const double limit_of_whole = transport_test::t_quantile(samples - 1.0, 1e-6 / 3 / 2);
    const auto compare = [&](const Region& region, int channel, double limit) {
        const transport_test::Measured mine = transport_test::measure(ours, region, channel);
        const double other = transport_test::mean_over(theirs, region, channel);
        // The pixels and sums of pbrt are floats: 2e-6 of the mean. And where no variance was
        // observed, the error is unknown: light that only a rare sample finds (the floor, edge-on
        // below the horizon) is allowed one sample of average brightness more or less.
        const double floats = 2e-6 * other;
        const double one_sample =
            transport_test::mean_over(theirs, transport_test::whole(theirs), channel) /
            ((region.x1 - region.x0) * (region.y1 - region.y0) * samples);
        const double se =
            std::hypot(std::hypot(mine.standard_error, floats),
                       std::hypot(standard_error_over(their_errors, region, channel), one_sample));
        EXPECT_LE(std::abs(mine.mean - other), limit * se)
            << "pixels from " << region.x0 << ',' << region.y0 << " channel " << channel << ": "
            << mine.mean << " against " << other;
        return se / other;
    };
    for (int y = 0; y < theirs.height; y += 8)
        for (int x = 0; x < theirs.width; x += 8)
            for (int channel = 0; channel < 3; ++channel)
                compare({x, y, x + 8, y + 8}, channel, limit_of_tiles);
    for (int channel = 0; channel < 3; ++channel) {
        const double se = compare(transport_test::whole(theirs), channel, limit_of_whole);
        // A global bias of 0.5% would be detected with 99% power.
        const double detectable =
            se * (limit_of_whole + transport_test::t_quantile(samples - 1.0, 0.01));
        std::printf("[ POWER    ] %s against another renderer, channel %d: a bias of %.2f%%\n",
                    GetParam().name, channel, 100.0 * detectable);
        EXPECT_LE(detectable, 0.005);
    }
}

} // namespace
