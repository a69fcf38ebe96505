#pragma once

// Random cases of a ray at the surface of glass, with the exact answer, for several axes.

#include "extremes/exact.h"
#include "extremes/wing.h"

#include <functional>
#include <optional>

namespace extremes {

/// A ray that arrives at glass.
struct GlassCase {
    Exact excess;     // index of refraction of the glass, less 1
    bool outside;     // whether the ray comes from the side with index 1
    Exact eta;        // index on the ray's side over the index on the other
    Exact cos2_i;     // square of the cosine of incidence
    Exact cos2_t;     // of refraction; negative under total reflection
    double azimuth_x; // of the plane of incidence; a unit vector up to rounding
    double azimuth_y;
};

/// With a given cosine of incidence, 0 < cos_i <= 1.
GlassCase incident(const Exact& excess, bool outside, double cos_i, Random& random);

/// With a given square of the cosine of refraction, at most 1 and above 1 - eta^2.
GlassCase refracted(const Exact& excess, bool outside, const Exact& cos2_t, Random& random);

/// What a method is given.
struct GlassInput {
    scenes::Vec3 wo_local; // towards where the ray comes from: unit length up to rounding
    double ior;
    double excess; // ior - 1, before ior was rounded
};

/// What it computes: the share of the light that is reflected, and the refracted ray.
struct GlassAnswer {
    double reflected;
    double transmitted = 0; // share of the light
    bool refracts = false;  // whether there is a refracted ray; without it, the rest has no meaning
    scenes::Vec3 wi_local{0.0};
    double scale = 1; // of radiance: eta^2
};

using GlassFunction = std::function<GlassAnswer(const GlassInput&)>;

/// ref/transport/bsdf.h or cuda/transport/bsdf.h. A GPU throws the exceptions of probes.h.
GlassAnswer glass_by(Wing wing, const GlassInput& input);

/// A usual way to compute the same.
struct GlassTrick {
    std::string name;
    Format format;
    GlassFunction compute;
};
std::vector<GlassTrick> glass_tricks();

/// Draws a case at a value of the parameter.
using GlassDraw = std::function<GlassCase(double parameter, Random& random)>;

/// The largest of three errors: of the reflected share, relative to the light that arrives; of the
/// refracted direction, in radians; of the scale, relative to itself. The latter two only where both the
/// answer and the truth have a refracted ray.
double error_of(const GlassCase& glass, const GlassAnswer& answer);

/// Our wings and the tricks, with this error, on cases from `draw`.
std::vector<Method> glass_methods(const GlassDraw& draw);

/// The same with the error of the transmitted share relative to itself. Failure::leaked: something
/// passes where all light is reflected.
Method transmission_method(std::string name, Format format, const GlassFunction& compute,
                           const GlassDraw& draw);

/// The bound on the absolute error of the computed square of the cosine of refraction.
double error_of_cos2_t(Format format, double eta);

/// The bound on what the reflected share adds to the error that cos_t brings, and on the error of the
/// scale.
double error_of_shares(Format format);

} // namespace extremes
