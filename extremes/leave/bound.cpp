#include "extremes/leave/bound.h"

#include <numbers>

namespace extremes {

double bound_of_leaving(Format format, double extent, double farthest, double cosine,
                        double first_cosine)
{
    const double a = extent;
    const double M = farthest;
    const double c = cosine;
    const double d = first_cosine;
    constexpr double r3 = std::numbers::sqrt3;
    double bound = (r3 * (7 / d + 22 + 7) * a + 4 * r3 * M) / c + 4 * r3 * a;
    if (format == Format::binary32) bound += (r3 * (2 * M + r3 * a) / d + r3 * M + 3 * a) / c;
    return bound * unit_roundoff(format);
}

} // namespace extremes
