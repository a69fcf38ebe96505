// An eye far away from the scene.

#include "extremes/axes/axes.h"
#include "extremes/far/far_eye.h"
#include "extremes/far/met_points.h"

#include "scenes/placed.h"

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

auto far_camera_cases(const EyeTracer& trace)
{
    return [trace](double parameter, Random& random, int cases, Tally& tally) {
        for (int done = 0; done < cases; done += rays_of_far_eye) {
            FarEye far = far_eye(parameter, random);
            far.targets.resize(static_cast<std::size_t>(std::min(rays_of_far_eye, cases - done)));
            std::vector<scenes::Vec3> towards;
            for (const ExactVec3& target : far.targets)
                towards.push_back(rounded_unit(target - ExactVec3(far.scene.camera->eye)));
            const scenes::Scene scene = scenes::placed(far.scene);
            const double unit = scene.unit / far.scene.unit;
            const MetPoints met = trace(scene, towards);
            for (std::size_t i = 0; i < met.size(); ++i)
                if (!met[i])
                    tally.add(Failure::missed);
                else
                    tally.add(length(ExactVec3(*met[i] / unit) - far.targets[i]).to_double());
        }
    };
}

// How far off is the point that is met? Let u be the unit roundoff and D the distance of the eye;
// lengths are in diameters. To first order in u:
//
// 1. The direction is rounded, which moves the ray by u D across. In single precision the eye is
//    rounded, too: u D more.
// 2. The cube. A vertex at m from the eye has the sheared coordinate m_x - S m_z, where S m_z is nearly
//    m_x. m_x, m_z, S and the product are rounded: 4 u |m_x|. Across the ray's longest axis that is
//    4 u sqrt(m_x^2 + m_y^2) <= 4 u D sqrt(2/3) < 3.3 u D. The weights are those of the moved vertices,
//    so the point is moved by as much, and along the surface by 1 / cos of it. The cosine is that
//    between the ray and the normal: at least 1 / sqrt(3) far away, because the side faces the eye.
// 3. The sphere. f = o - c is rounded: the ray moves by u D across. The point where it meets the surface
//    moves by 1 / cos of this and of step 1. t = c / q: the relative error of c is 4 u (three squares
//    and two sums, 3 u; r^2). q = b + sqrt(r^2 - l^2): b has 3 u, the sum 1 u, and l, a sum of two
//    numbers of size D, an error of 3 u D, of which the root makes 3 u D at sin <= 0.7. With the
//    quotient that is 12 u D along the ray. It moves the point along the surface by the sine of the
//    angle between the ray and the normal. The product of t and the direction is rounded: u D.
// D is the distance to the surface, and the coordinates of the scene itself are rounded: D + 1 covers
// both.
double bound_of_far_camera(Format format, double distance)
{
    const double u = unit_roundoff(format);
    const double ends = format == Format::binary64 ? 1 : 2; // direction, eye
    // The cosines at a surface that is not infinitely far away: the eye is at `distance` from the
    // middle.
    const auto cosine = [&](double far, double half) {
        return (far * distance - half) / (distance + half);
    };
    const double on_cube = cosine(1 / std::sqrt(3.0), 0.289); // half an edge
    const double cube = (3.3 + ends) / on_cube;
    const double on_sphere = cosine(std::sqrt(1 - far_sphere_sine * far_sphere_sine), 0.289);
    const double sphere = (1 + ends) / on_sphere + 12 * std::sqrt(1 - on_sphere * on_sphere) + 1;
    return 1.01 * u * std::max(cube, sphere) * (distance + 1);
}

} // namespace

Axis far_camera_axis()
{
    Axis axis;
    axis.number = 3;
    axis.name = "far-camera";
    axis.title = "Distance of the eye";
    axis.parameter = "distance of the eye from the middle of the scene, in diameters of the scene";
    axis.about =
        "The scene is a cube or a sphere near the origin. A ray from the eye is aimed at a random point "
        "of it: of the cube, on the side that faces the eye; of the sphere, within 0.7 of its outline. "
        "The error is the distance between this point and the one that the ray meets, in diameters of "
        "the scene. A ray that meets nothing has missed. The truth is the point itself, which the ray "
        "would meet without rounding.";
    axis.ordinary = 1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 18, 0.5);
    for (const Wing wing : wings())
        axis.methods.push_back({name_of(wing), format_of(wing),
                                far_camera_cases([wing](const scenes::Scene& scene,
                                                        const std::vector<scenes::Vec3>& towards) {
                                    return met_by(wing, scene, towards);
                                })});
    axis.methods.push_back(
        {"first moved to the scene (float)", Format::binary32, far_camera_cases(met_from_nearby)});
    const std::string because = "the eye and the direction are rounded to 2^-24 (2^-53 in double) of "
                                "the distance, and so are the differences between the eye and a vertex";
    axis.limits = {{"ref", 7e12, [](double x) { return bound_of_far_camera(Format::binary64, x); }, 6e13,
                    Failure::inaccurate, because},
                   {"host", 1.1e4, [](double x) { return bound_of_far_camera(Format::binary32, x); },
                    1e5, Failure::inaccurate, because}};
    axis.derivation =
        "at the distance D (in diameters) the direction is off by u D across the ray, and the eye "
        "by as much in single precision. A vertex at the distance D is sheared with an error "
        "below 3.3 u D. The rounding of the quotient that gives the distance of a sphere is 12 u "
        "D along the ray. With the cosines of the surfaces that makes about 12 u D (14 u D in "
        "single precision).";
    return axis;
}

} // namespace extremes
