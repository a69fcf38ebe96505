// An outside picture: CBspheres_lambertian.dae as another renderer made it, with its standard errors.

#include "golden/pfm.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/render.h"
#include "tests/transport/estimate.h"
#include "tests/transport/scene_files.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>

#include <filesystem>

namespace {

using tests::Region;

/// Standard error of a region's mean, from those of its pixels, which are independent.
double standard_error_over(const golden::Image& errors, const Region& region, int channel)
{
    double sum = 0.0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
            const double e = errors.pixels[static_cast<std::size_t>(y * errors.width + x)][channel];
            sum += e * e;
        }
    return std::sqrt(sum) / ((region.x1 - region.x0) * (region.y1 - region.y0));
}

TEST(CourseScene, AgreesTileByTileWithAnotherRenderersPicture)
{
    const auto scene_path = tests::shared_file("scenes/CBspheres_lambertian.dae");
    const auto picture_path = tests::shared_file("pbrt/CBspheres_lambertian_a6.pfm");
    if (!std::filesystem::exists(scene_path) || !std::filesystem::exists(picture_path))
        GTEST_SKIP() << "the course's scenes and pbrt's picture are not here: " << scene_path;
    const golden::Image theirs = golden::read_pfm(picture_path);
    const golden::Image their_errors =
        golden::read_pfm(tests::shared_file("pbrt/CBspheres_lambertian_a6_se.pfm"));

    const scenes::Scene scene = scenes::read_scene(scene_path);
    const ref::World world(scene, theirs.width, theirs.height);
    golden::Film film(theirs.width, theirs.height);
    constexpr int samples = 96;
    // 24 batches: each pixel's error is known to 15%, a tile's, of 64 pixels, to 2%.
    ref::render(world, ref::trace_path, {{.seed = 1, .max_edges = 6}, 24, 4, 2}, film);
    const golden::Image errors = film.standard_error();

    // Normal quantiles at a level of 1e-6 over all 1800 tiles and channels together. A tile averages 64
    // pixels of 96 samples each, diffusely lit: close to normal.
    const boost::math::normal normal;
    const double limit = boost::math::quantile(boost::math::complement(normal, 1e-6 / 1800 / 2));
    const auto compare = [&](const Region& region, int channel) {
        const double mine = tests::mean_over(film.mean(), region, channel);
        const double other = tests::mean_over(theirs, region, channel);
        // Their pixels are floats, and so were their sums: 2e-6 of the mean. And where nothing varies,
        // nothing is known: what only a rare sample finds (the floor, edge-on below the horizon) counts
        // with one sample of average brightness more or less.
        const double floats = 2e-6 * other;
        const double one_sample = tests::mean_over(theirs, tests::whole(theirs), channel) /
                                  ((region.x1 - region.x0) * (region.y1 - region.y0) * samples);
        const double se =
            std::hypot(std::hypot(standard_error_over(errors, region, channel), floats),
                       std::hypot(standard_error_over(their_errors, region, channel), one_sample));
        EXPECT_LE(std::abs(mine - other), limit * se)
            << "pixels from " << region.x0 << ',' << region.y0 << " channel " << channel << ": " << mine
            << " against " << other;
        return se / other;
    };
    for (int y = 0; y < theirs.height; y += 8)
        for (int x = 0; x < theirs.width; x += 8)
            for (int channel = 0; channel < 3; ++channel) compare({x, y, x + 8, y + 8}, channel);
    for (int channel = 0; channel < 3; ++channel) {
        const double se = compare(tests::whole(theirs), channel);
        // With 99% power a global bias of 0.5% would have been seen.
        EXPECT_LE(se * (limit + boost::math::quantile(normal, 0.99)), 0.005);
    }
}

} // namespace
