// An emitter so small that it is nearly a point, with the same power.

#include "extremes/axes/axes.h"
#include "extremes/light/shadow_tricks.h"
#include "extremes/light/small_render.h"
#include "extremes/light/under_emitter.h"

#include "scenes/placed.h"

#include <cmath>
#include <string>

namespace extremes {

namespace {

constexpr int samples_of_emitter = 256; // of the one pixel

auto emitter_size_cases(Wing wing, images::Integrator integrator)
{
    return [=](double size, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i) {
            const UnderEmitter under = under_square(size, random);
            images::RenderOptions options;
            options.integrator = integrator;
            options.max_edges = 3;
            options.batch_size = samples_of_emitter;
            options.seed = random.bits();
            judge_small_render(tally, [&] {
                const scenes::Scene scene = scenes::placed(under.scene);
                const double value = small_render(wing, scene, 1, options).pixels[0].r;
                if (value == 0)
                    tally.add(Failure::missed);
                else
                    tally.add(std::abs(value / under.radiance - 1));
            });
        }
    };
}

// Let u be the unit roundoff, s the size, d >= 0.5 the distance, h = d cos >= 0.25 the height.
//
// 1. Noise. A point of the square at the offset a from the middle, in the plane of the square, changes
//    cos cos' / d^2 = (up . d) (n . d) / d^4 by a (1 / h + 4 / d) <= 12 a. The standard deviation of a
//    uniform a along an axis is s / sqrt(12): 3.5 s, and 0.22 s for the mean of 256 samples. 6 of them:
//    1.4 s. The square of s adds less than 0.1 s. A ray from the floor meets the emitter by chance with
//    the probability s^2 cos' / (pi d^2), and then counts as one sample of 256 (the balance heuristic).
//    Below s = 3e-5 that is one case in 10^6.
// 2. The pixel spans 0.6 fov / cos of the floor, and 12 times this is less than 12 fov.
// 3. Vertices. The coordinates of the square are less than 1. In double they were rounded in two
//    sums, by u together; in single precision, where the middle of the scene is the origin, by u / 2. A
//    vertex moves by sqrt(3) u along the normal at most, and the plane of a right triangle with the legs
//    s turns by 2 sqrt(2) sqrt(3) u / s = 4.9 u / s. The cosine at the emitter changes by tan(60
//    degrees) times this: 8.5 u / s, or half of it for floats. The area has an error, too: displacements
//    of sqrt(3) u over the half perimeter 1.71 s, relative to s^2 / 2: 5.9 u / s. The fast path computes
//    areas in double.
// 4. The rest. The point of the floor has an error of less than 90 u: 72 u where it is moved off the
//    edge of its triangle (clearance.h), 7 u of its weights, and the roundings of vertices: 12 times
//    that. 30 roundings of the contribution; and 256 samples are summed one by one.
double bound_of_emitter_size(Format format, double size)
{
    const bool is_double = format == Format::binary64;
    const double u = unit_roundoff(format);
    const double by_chance = size > 3e-5 ? 1.0 / samples_of_emitter : 0;
    const double of_vertices = is_double ? 8.5 + 5.9 : 8.5 / 2;
    return 1.5 * size + by_chance + 12 * fov_of_emitter + u * (of_vertices / size + 12 * 90 + 30 + 255);
}

} // namespace

Axis emitter_size_axis()
{
    Axis axis;
    axis.number = 9;
    axis.name = "emitter-size";
    axis.title = "Size of an emitter of constant power";
    axis.parameter = "size of the emitter, relative to its distance";
    axis.about =
        "A small square emitter, turned at random, over a square floor; its radiance is pi watts "
        "through "
        "its area. A case is the mean of 256 samples of one point of the floor. Every sample sees "
        "nearly "
        "the same light, so there is hardly any noise. The error is that of the radiance, relative to "
        "itself. The truth is that of a point: albedo / pi times power / pi times both cosines over "
        "squared distance. With the usual tricks, which keep a shadow ray off the surfaces at both of "
        "its "
        "ends, each sample is a textbook estimate of direct light. The tricks agree, because the ends "
        "are "
        "far apart; only excluding differs, where the end is rounded into the neighbouring triangle of "
        "the emitter, which then shadows it.";
    axis.ordinary = 1e-4;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-20, -2, 0.5);
    axis.most_cases = 1000;
    for (const Wing wing : wings()) {
        axis.methods.push_back({name_of(wing) + ", path", format_of(wing),
                                emitter_size_cases(wing, images::Integrator::path)});
        axis.methods.push_back({name_of(wing) + ", bdpt", format_of(wing),
                                emitter_size_cases(wing, images::Integrator::bdpt)});
    }
    for (Method& trick : shadow_tricks(samples_of_emitter)) axis.methods.push_back(std::move(trick));
    for (const char* integrator : {"path", "bdpt"}) {
        const std::string name = integrator;
        const std::string because = "the corners of the emitter are rounded to 2^-24 (2^-53 in double) "
                                    "of the scene: its normal turns "
                                    "by up to 5 u / s, and the cosine with it";
        axis.limits.push_back({"ref, " + name, 1.6e-13,
                               [](double s) { return bound_of_emitter_size(Format::binary64, s); },
                               1.6e-14, Failure::inaccurate, because});
        axis.limits.push_back({"host, " + name, 3e-5,
                               [](double s) { return bound_of_emitter_size(Format::binary32, s); }, 3e-6,
                               Failure::inaccurate, because});
    }
    return axis;
}

} // namespace extremes
