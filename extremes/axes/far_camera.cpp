// An eye far away from the scene.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"

#include "cuda/launch/ray_pairs.h"
#include "ref/trees/geometry.h"
#include "scenes/contacts.h"
#include "scenes/placed.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace extremes {

namespace {

constexpr int rays_of_far_eye = 10;
constexpr double far_sphere_sine = 0.7; // of the angle between its normals and the eye, at most

/// A cube or a sphere of diameter 1 (of the sphere: the diagonal of its box) with an eye, and points of
/// it that the eye sees.
struct FarEye {
    scenes::Scene scene;
    std::vector<ExactVec3> targets;
};

/// Two unit vectors that make a frame with the unit vector `z`.
std::pair<scenes::Vec3, scenes::Vec3> axes_across(const scenes::Vec3& z, Random& random)
{
    const scenes::Vec3 x = glm::normalize(glm::cross(z, random.direction()));
    return {x, glm::cross(z, x)};
}

void add_far_sphere(FarEye& far, const scenes::Vec3& to_eye, Random& random)
{
    const scenes::Sphere sphere{0.1 * random.direction(), 0.5 / std::sqrt(3.0), 0};
    far.scene.spheres = {sphere};
    const auto [x, y] = axes_across(to_eye, random);
    for (int i = 0; i < rays_of_far_eye; ++i) {
        const double sine = far_sphere_sine * std::sqrt(random.uniform());
        const double phi = random.between(0, 6.28);
        const scenes::Vec3 across = std::cos(phi) * x + std::sin(phi) * y;
        const ExactVec3 normal(std::sqrt(1 - sine * sine) * to_eye + sine * across);
        far.targets.push_back(ExactVec3(sphere.center) +
                              (Exact(sphere.radius) / length(normal)) * normal);
    }
}

void add_far_cube(FarEye& far, const scenes::Vec3& to_eye, Random& random)
{
    const scenes::Vec3 z = random.direction();
    const auto [x, y] = axes_across(z, random);
    const scenes::Vec3 center = 0.1 * random.direction();
    const double half = 0.5 / std::sqrt(3.0);
    double best = 0;
    for (const scenes::Vec3& normal : {x, -x, y, -y, z, -z}) {
        const auto [u, v] = normal == x || normal == -x   ? std::pair(y, z)
                            : normal == y || normal == -y ? std::pair(z, x)
                                                          : std::pair(x, y);
        const auto corner = [&, u = u, v = v](double a, double b) {
            return center + half * (normal + a * u + b * v);
        };
        const auto first = far.scene.triangles.size();
        far.scene.triangles.push_back({{corner(-1, -1), corner(1, -1), corner(-1, 1)}, 0});
        far.scene.triangles.push_back({{corner(1, 1), corner(-1, 1), corner(1, -1)}, 0});
        if (glm::dot(normal, to_eye) <= best) continue; // of all faces the one that faces the eye
        best = glm::dot(normal, to_eye);
        far.targets.clear();
        for (int i = 0; i < rays_of_far_eye; ++i) {
            const auto& p = far.scene.triangles[first + random.below(2)].vertices;
            const double b1 = random.between(0.05, 0.9);
            const double b2 = random.between(0.05, 0.95 - b1);
            far.targets.push_back(ExactVec3(p[0]) + Exact(b1) * (ExactVec3(p[1]) - ExactVec3(p[0])) +
                                  Exact(b2) * (ExactVec3(p[2]) - ExactVec3(p[0])));
        }
    }
}

FarEye far_eye(double distance, Random& random)
{
    FarEye far;
    const scenes::Vec3 to_eye = random.direction();
    far.scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    far.scene.material_names = {"grey"};
    far.scene.camera = scenes::Camera{distance * to_eye,           {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      scenes::FovAxis::horizontal, 1};
    if (random.sign() > 0)
        add_far_cube(far, to_eye, random);
    else
        add_far_sphere(far, to_eye, random);
    return far;
}

/// The points that the rays from the eye in the unit directions `towards` meet.
using MetPoints = std::vector<std::optional<scenes::Vec3>>;
using FarTracer = MetPoints (*)(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards);

MetPoints met_by_reference(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards)
{
    const ref::Geometry geometry(scene);
    const std::vector<std::uint32_t> on = scenes::surfaces_at(scene, scene.camera->eye);
    MetPoints met;
    for (const scenes::Vec3& direction : towards) {
        const ref::Ray ray{scene.camera->eye, direction, std::numeric_limits<double>::infinity(), on};
        const auto hit = ref::intersect(geometry, ray);
        met.push_back(hit ? std::optional(ref::surface_point(geometry, ray, *hit).position)
                          : std::nullopt);
    }
    return met;
}

/// `moved_near`: the origin of each ray is moved along it to the scene, in double, before it is rounded.
MetPoints met_by_floats(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards,
                        bool moved_near)
{
    const fast::SceneArrays arrays = fast::scene_arrays(scene, false);
    const scenes::Vec3 eye = scene.camera->eye;
    const double distance = glm::length(eye - arrays.place.origin);
    std::vector<fast::RayPair> pairs;
    for (const scenes::Vec3& direction : towards) {
        const scenes::Vec3 from =
            moved_near ? eye + std::max(0.0, distance - 1 / arrays.place.scale) * direction : eye;
        const fast::Vec3 d(direction);
        pairs.push_back({{arrays.place(from), std::numeric_limits<float>::infinity(), d}, -d});
    }
    MetPoints met;
    const auto hits = fast::trace_ray_pairs(arrays, pairs);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const fast::Hit& hit = hits[i].first;
        if (hit.primitive == fast::no_primitive) {
            met.emplace_back();
            continue;
        }
        fast::Vec3 position;
        if (hit.primitive < arrays.triangles.size()) {
            const auto& v = arrays.triangles[hit.primitive].vertices;
            position = v[0] + (hit.b1 * (v[1] - v[0]) + hit.b2 * (v[2] - v[0]));
        } else {
            const fast::Sphere& sphere = arrays.spheres[hit.primitive - arrays.triangles.size()];
            const fast::Ray& ray = pairs[i].first;
            position =
                sphere.center +
                sphere.radius * glm::normalize(ray.origin + hit.t * ray.direction - sphere.center);
        }
        met.emplace_back(arrays.place.origin + scenes::Vec3(position) / arrays.place.scale);
    }
    return met;
}

auto far_camera_cases(FarTracer trace)
{
    return [trace](double parameter, Random& random, int cases, Tally& tally) {
        for (int done = 0; done < cases; done += rays_of_far_eye) {
            FarEye far = far_eye(parameter, random);
            far.targets.resize(static_cast<std::size_t>(std::min(rays_of_far_eye, cases - done)));
            std::vector<scenes::Vec3> towards;
            for (const ExactVec3& target : far.targets) {
                const ExactVec3 d = target - ExactVec3(far.scene.camera->eye);
                const Exact scale = 1 / length(d);
                towards.emplace_back((scale * d.x).convert_to<double>(),
                                     (scale * d.y).convert_to<double>(),
                                     (scale * d.z).convert_to<double>());
            }
            const scenes::Scene scene = scenes::placed(far.scene);
            const double unit = scene.unit / far.scene.unit;
            const MetPoints met = trace(scene, towards);
            for (std::size_t i = 0; i < met.size(); ++i)
                if (!met[i])
                    tally.add(Failure::missed);
                else
                    tally.add(length(ExactVec3(*met[i] / unit) - far.targets[i]).convert_to<double>());
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
    const double u = format == Format::binary64 ? 0x1p-53 : 0x1p-24;
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
    axis.methods = {
        {"ref", Format::binary64, far_camera_cases(met_by_reference)},
        {"host", Format::binary32,
         far_camera_cases([](const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards) {
             return met_by_floats(scene, towards, false);
         })},
        {"first moved to the scene (float)", Format::binary32,
         far_camera_cases([](const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards) {
             return met_by_floats(scene, towards, true);
         })}};
    const std::string because = "the eye and the direction are rounded to 2^-24 (2^-53 in double) of "
                                "the distance, and so are the differences between the eye and a vertex";
    axis.limits = {{"ref", 7e12, [](double x) { return bound_of_far_camera(Format::binary64, x); }, 6e13,
                    Failure::inaccurate, because},
                   {"host", 1.1e4, [](double x) { return bound_of_far_camera(Format::binary32, x); },
                    1e5, Failure::inaccurate, because}};
    return axis;
}

} // namespace extremes
