#include "tests/cuda/transport/lit_plane.h"
#include "tests/cuda/transport/odd_things.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;

namespace {

using std::numbers::pi;

/// The integral over the square [-1, 1]^2.
template <class Value>
auto square_integral(const Value& value)
{
    // Nodes and weights of order 6 [Abramowitz & Stegun 1964, tab. 25.4].
    constexpr std::array node = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    constexpr std::array weight = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    decltype(value(0.0, 0.0)) sum(0.0);
    const auto along = [&](int i) { // two halves per axis
        const double x = node[static_cast<std::size_t>(i / 2 % 3)] * (i % 2 == 0 ? 1 : -1);
        return std::pair((x + (i < 6 ? 1 : -1)) / 2, weight[static_cast<std::size_t>(i / 2 % 3)] / 2);
    };
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
            const auto [x, wx] = along(i);
            const auto [y, wy] = along(j);
            sum += wx * wy * value(x, y);
        }
    return sum;
}

/// The mean of `irradiance` over the film.
Rgb mean_over_film(const PlaneEye& eye, const Irradiance& irradiance)
{
    return square_integral([&](double x, double y) {
               const Vec3 w = eye.along + eye.span * (x * eye.right + y * eye.up);
               return irradiance(eye.from - eye.from.z / w.z * w);
           }) /
           4.0;
}

/// The mean over the film of the irradiance from a spot light whose whole cone is visible: the
/// integral of its flux over the directions around `axis` within the angle of cosine `cos_cutoff`. A
/// piece of the plane dA at distance d covers the fraction dA cos / d^2 / cos_film^3 / (2 span)^2 of
/// the film.
double mean_of_narrow_spot(const PlaneEye& eye, const Vec3& from, const Vec3& axis, double cos_cutoff,
                           double exponent)
{
    const Vec3 a =
        glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(0, 1, 0)));
    const Vec3 b = glm::cross(axis, a);
    const double height = 1 - cos_cutoff; // 1 - cos is uniform in solid angle
    return square_integral([&](double x, double y) {
               const double drop = height * (x + 1) / 2;
               const double r = std::sqrt(drop * (2 - drop));
               const Vec3 w = (1 - drop) * axis + r * std::cos(pi * y) * a + r * std::sin(pi * y) * b;
               const Vec3 to_point = from - from.z / w.z * w - eye.from;
               const double d = glm::length(to_point);
               const double cos_film = glm::dot(to_point, eye.along) / d;
               return std::pow(1 - drop, exponent) * std::abs(to_point.z) /
                      (d * d * d * std::pow(cos_film, 3));
           }) /
           4.0 * 2 * pi * height / (4 * eye.span * eye.span);
}

} // namespace

void LitPlane::light(const Irradiance& irradiance)
{
    irradiance_ += mean_over_film(eye_, irradiance);
}

Vec3 LitPlane::any_place()
{
    const double height = builder_.any_size(0.25, 1);
    if (builder_.exact()) return {0, 0, height}; // above a vertex
    return {builder_.any(-0.6, 0.6), builder_.any(-0.6, 0.6), height};
}

void LitPlane::add_point()
{
    Vec3 p = any_place();
    Rgb intensity = builder_.any_colour(0.5, 2);
    if (builder_.chance(0.3)) {
        p = {0, -1, builder_.any_size(1e-4, 0.05)};
        builder_.say("point light above the plane by", p.z);
        intensity /= p.z; // so that its effect is not much smaller
        watch(p.z);
        far_or_low_ = true;
    } else {
        builder_.say("point light");
    }
    builder_.add_point_light(p, intensity);
    light([p, intensity](const Vec3& x) {
        const double d = glm::length(p - x);
        return intensity * p.z / (d * d * d);
    });
}

void LitPlane::add_spot()
{
    const Vec3 p = any_place();
    const Vec3 axis = glm::normalize(-p);
    const double exponent = builder_.chance(0.3) ? 0 : builder_.any(0, 9);
    const Rgb intensity = builder_.any_colour(0.5, 2);
    builder_.say("spot light");
    // All points within 0.5 of the origin are in the cone: the cosine of the largest angle, minus a
    // little.
    double cutoff = 1;
    for (int i = 0; i < 64; ++i) {
        const Vec3 x(0.5 * std::cos(i * pi / 32), 0.5 * std::sin(i * pi / 32), 0);
        cutoff = std::min(cutoff, glm::dot(glm::normalize(x - p), axis));
    }
    builder_.add_spot_light(p, axis, intensity, builder_.any(-1, cutoff - 0.02), exponent);
    light([p, axis, intensity, exponent](const Vec3& x) {
        const double d = glm::length(p - x);
        const double cosine = std::max(0.0, glm::dot(x - p, axis) / d);
        return intensity * std::pow(cosine, exponent) * p.z / (d * d * d);
    });
}

void LitPlane::add_narrow_spot()
{
    const Vec3 p = any_place();
    const Vec3 at = eye_.from - eye_.from.z / eye_.along.z * eye_.along; // the middle of the picture
    const Vec3 axis = glm::normalize(at - p);
    // The picture is at least 2 span |at - eye| wide there; the width of the spot is that of its angle
    // on a slanting plane.
    const double widest = 0.5 * eye_.span * glm::length(at - eye_.from) / glm::length(at - p) * -axis.z;
    const double angle = std::max(narrowest_spot, builder_.any_size(1e-3, 0.9) * widest);
    const double exponent = builder_.chance(0.5) ? 0 : builder_.any(0, 9);
    const double cutoff = std::cos(angle);
    builder_.say("narrow spot light of half angle", angle);
    const Rgb intensity = builder_.any_colour(0.5, 2) / (angle * angle);
    builder_.add_spot_light(p, axis, intensity, cutoff, exponent);
    irradiance_ += intensity * mean_of_narrow_spot(eye_, p, axis, cutoff, exponent);
    narrow_ = true;
    // Directions have an error of at most sqrt(3) unit roundoffs, which changes the width of the cone
    // by as much at both ends.
    spot_tolerance_ = 4 * 0x1p-24 / angle;
}

void LitPlane::add_sun()
{
    const bool low = builder_.chance(0.3);
    const double z = low ? builder_.any_size(1e-4, 0.1) : builder_.any(0.2, 1);
    // From the side of x > 0; the lamp is on the other side.
    const Vec3 w = builder_.exact() && !low ? Vec3(0, 0, -1) : Vec3(-std::sqrt(1 - z * z), 0, -z);
    if (low) {
        builder_.say("sun above the horizon by", z);
        watch(z);
    } else {
        builder_.say("sun");
    }
    const Rgb irradiance = builder_.any_colour(0.5, 2) / -w.z;
    builder_.add_sun(w, irradiance);
    irradiance_ += irradiance * -w.z;
    far_or_low_ = true;
}

void LitPlane::add_sky()
{
    const Rgb radiance = builder_.any_colour(0.2, 1);
    builder_.say("sky");
    builder_.set_sky(radiance);
    irradiance_ += radiance * (pi - under_sky_);
    far_or_low_ = true;
}

/// A square lamp above the plane, farther than the point lights from every visible point. The sky is
/// set later.
void LitPlane::add_lamp()
{
    const bool tiny = builder_.chance(0.3);
    const double width = tiny ? builder_.any_size(smallest_thing, 0.1) : builder_.any(0.1, 1);
    const Vec3 p(-2.5, builder_.any(-1, 0), builder_.any(1.5, 3));
    const Rgb radiance = builder_.any_colour(1, 4) / (width * width);
    const int pieces = tiny ? 1 : 1 + builder_.pick(6);
    builder_.say("lamp of width", width);
    builder_.say("in strips:", pieces);
    const std::uint32_t lamp = builder_.add_material(scenes::Emission{radiance}, "lamp");
    for (int i = 0; i < pieces; ++i)
        builder_.add_quad(p + Vec3(width * i / pieces, 0, 0), Vec3(0, width, 0),
                          Vec3(width / pieces, 0, 0), lamp);
    const std::array corners = {p, p + Vec3(0, width, 0), p + Vec3(width, width, 0),
                                p + Vec3(width, 0, 0)};
    const Irradiance per_radiance = [corners](const Vec3& x) {
        // Half the sum, over the edges, of the angle that an edge subtends times the cosine between
        // the normal of the plane and that of the plane through the edge and the point.
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 a = corners[i] - x;
            const Vec3 b = corners[(i + 1) % 4] - x;
            const Vec3 across = glm::cross(a, b);
            const double length = glm::length(across);
            sum += std::atan2(length, glm::dot(a, b)) * across.z / length;
        }
        return Rgb(std::abs(sum) / 2);
    };
    far_or_low_ = true;
    under_sky_ = mean_over_film(eye_, per_radiance);
    irradiance_ += under_sky_ * radiance;
    watch(width / pieces);
}

} // namespace fast_transport_test
