#include "extremes/camera_case.h"

#include "cuda/scene/scene_arrays.h"
#include "ref/transport/camera.h"

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace extremes {

namespace {

struct ExactFrame {
    ExactVec3 right, up, backward;
};

/// A rotation, exactly orthonormal: that of a random quaternion.
ExactFrame random_frame(Random& random)
{
    const Exact w = random.between(-1, 1);
    const Exact x = random.between(-1, 1);
    const Exact y = random.between(-1, 1);
    const Exact z = random.between(-1, 1);
    const Exact s = 2 / (w * w + x * x + y * y + z * z);
    return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
            {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
}

scenes::Vec3 rounded(const ExactVec3& v)
{
    return {v.x.convert_to<double>(), v.y.convert_to<double>(), v.z.convert_to<double>()};
}

/// A point of the film, in pixels from the top left corner; or a pixel, if `size` is 1.
struct FilmPlace {
    double x, y;
    double size = 0;
};

double distance_to(const FilmPlace& place, const Exact& x, const Exact& y)
{
    const auto along = [&](double from, const Exact& at) {
        return std::max({0.0, (Exact(from) - at).convert_to<double>(),
                         (at - Exact(from + place.size)).convert_to<double>()});
    };
    return std::hypot(along(place.x, x), along(place.y, y));
}

/// How deep in the picture a point is.
double depth_in_picture(double x, double y)
{
    return std::max(0.0, std::min({x, y, camera_pixels - x, camera_pixels - y}));
}

/// A camera of one of the wings.
struct RefCamera {
    explicit RefCamera(const scenes::Camera& camera) : camera_(camera, camera_pixels, camera_pixels) {}
    [[nodiscard]] scenes::Vec3 direction(double x, double y) const
    {
        return camera_.ray({x, y}).direction;
    }
    [[nodiscard]] std::optional<FilmPlace> project(const scenes::Vec3& w) const
    {
        const auto film = camera_.project(w);
        return film ? std::optional(FilmPlace{film->x, film->y}) : std::nullopt;
    }
    [[nodiscard]] double density(const scenes::Vec3& w) const { return camera_.pdf_solid_angle(w); }

private:
    ref::Camera camera_;
};

struct FastCamera {
    explicit FastCamera(const scenes::Camera& camera)
    {
        scenes::Scene scene;
        scene.camera = camera;
        camera_ = fast::camera_of(scene, {}, camera_pixels, camera_pixels);
    }
    [[nodiscard]] scenes::Vec3 direction(double x, double y) const
    {
        return scenes::Vec3(camera_.direction(static_cast<float>(x), static_cast<float>(y)));
    }
    [[nodiscard]] std::optional<FilmPlace> project(const scenes::Vec3& w) const
    {
        std::uint32_t pixel = 0;
        if (!camera_.project<float>(fast::Vec3(w), pixel)) return std::nullopt;
        return FilmPlace{static_cast<double>(pixel % camera_pixels),
                         static_cast<double>(pixel / camera_pixels), 1.0};
    }
    [[nodiscard]] double density(const scenes::Vec3& w) const
    {
        return camera_.pdf_solid_angle(camera_.cosine<float>(fast::Vec3(w)));
    }

private:
    fast::Camera camera_{};
};

/// The fast path with a field of view that was rounded to a float.
struct FastCameraOfFloats : FastCamera {
    explicit FastCameraOfFloats(scenes::Camera camera) : FastCamera(with_float(camera)) {}

private:
    static scenes::Camera with_float(scenes::Camera camera)
    {
        camera.fov = static_cast<float>(camera.fov);
        return camera;
    }
};

template <class Wing>
void add_camera_case(const FieldOfView& field, const Exact& pixel, Random& random, Tally& tally)
{
    const ExactFrame frame = random_frame(random);
    const Wing camera(scenes::Camera{scenes::Vec3(0.0), rounded(frame.right), rounded(frame.up),
                                     rounded(frame.backward), scenes::FovAxis::horizontal, field.fov});
    // Multiples of 2^-16, which floats hold as well.
    const auto film_coordinate = [&](double from, double to) {
        return std::floor(random.between(from, to) * 0x1p16) * 0x1p-16;
    };
    constexpr int half = camera_pixels / 2;

    const double x1 = film_coordinate(0, camera_pixels);
    const double y1 = film_coordinate(0, camera_pixels);
    const ExactVec3 direction(camera.direction(x1, y1));
    const Exact ahead = -dot(direction, frame.backward);
    if (!(ahead > 0)) {
        tally.add(Failure::not_finite);
        return;
    }
    const Exact to_film = 1 / (ahead * pixel);
    double error = distance_to({x1, y1}, half + dot(direction, frame.right) * to_film,
                               half - dot(direction, frame.up) * to_film);

    const double x2 = film_coordinate(-4, camera_pixels + 4);
    const double y2 = film_coordinate(-4, camera_pixels + 4);
    const ExactVec3 towards = (Exact(x2 - half) * pixel) * frame.right +
                              (Exact(half - y2) * pixel) * frame.up - frame.backward;
    const Exact away = length(towards);
    const scenes::Vec3 w = rounded((1 / away) * towards);
    const auto place = camera.project(w);
    error =
        std::max(error, place ? distance_to(*place, Exact(x2), Exact(y2)) : depth_in_picture(x2, y2));

    const Exact width = pixel * camera_pixels;
    const double density = camera.density(w);
    if (!std::isfinite(density))
        tally.add(Failure::not_finite);
    else
        tally.add(std::max(error, relative_error(density, away * away * away / (width * width))));
}

template <class Wing>
auto camera_cases(FieldOfView (*field)(double))
{
    return [field](double parameter, Random& random, int cases, Tally& tally) {
        const FieldOfView view = field(parameter);
        const Exact pixel = 2 * view.tan_half / camera_pixels;
        for (int i = 0; i < cases; ++i) add_camera_case<Wing>(view, pixel, random, tally);
    };
}

} // namespace

FieldOfView narrow_field(double degrees)
{
    const Exact half = Exact(degrees) * boost::math::constants::pi<Exact>() / 360;
    return {tan(half), (2 * half).convert_to<double>()};
}

FieldOfView wide_field(double less_than_180_degrees)
{
    const Exact half = Exact(less_than_180_degrees) * boost::math::constants::pi<Exact>() / 360;
    return {1 / tan(half), (boost::math::constants::pi<Exact>() - 2 * half).convert_to<double>()};
}

std::vector<Method> camera_methods(FieldOfView (*field)(double))
{
    return {{"ref", Format::binary64, camera_cases<RefCamera>(field)},
            {"host", Format::binary32, camera_cases<FastCamera>(field)},
            {"field of view as a float", Format::binary32, camera_cases<FastCameraOfFloats>(field)}};
}

// Let u be the unit roundoff, T the tangent of half the field of view, and q = T / 32 the width of a
// pixel at distance 1. A film point is at X, Y from the middle there; |X|, |Y| <= T (up to 9/8 T outside
// the picture), and L = sqrt(1 + X^2 + Y^2) is its distance from the eye. To first order in u:
//
// 1. The relative error p of the computed q. The field of view is rounded to a double, which moves the
//    tangent by u (1 + T), relative to itself: by its derivative (1 + T^2) / 2 times 2 u where the angle
//    is above 1, and by u where it is less. The tangent has an error of 2 u. In the reference p =
//    (3 + T) u. The fast path computes the same and rounds it: 1 u of single precision and a little.
// 2. The ray v = X right + Y up - backward. The axes are rounded (u), and so are X and Y (u, apart from
//    p), the products (u), the sum of two terms and the sum of three: an error of length e <=
//    3 u (|X| + |Y|) + u + u sqrt(X^2 + Y^2) + u L. The coordinates of the unit vector are rounded once
//    more, u L; its length does not matter. An error e of v moves the film point by
//    sqrt(1 + X^2) e / q at most, along each axis.
// 3. Back: w is rounded (u), the axes are, the products are, and the sums add 2 u: 5 u in each scalar
//    product of unit vectors. The cosine is 1 / L. The film point, relative to the middle, has an error
//    of 5 u L / q from the numerator; the rest is relative to at most 36 pixels: 5 u L from the cosine,
//    p, and 3 u. The sum with 32 adds u 68.
// 4. The density 1 / (A cos^3): 15 u L from the cosine, 2 p, and 7 u.
//
// In 2. the errors along both axes count: sqrt(2) times the largest. Likewise in 3.
double bound_of_camera(Format format, double tan_half)
{
    const bool is_double = format == Format::binary64;
    const double u = is_double ? 0x1p-53 : 0x1p-24;
    const double T = 1.125 * tan_half; // outside the picture, in 3 and 4; for simplicity also in 2
    const double q = tan_half / (0.5 * camera_pixels);
    const double p = is_double ? 3 + tan_half : 1.01;
    const double L = std::sqrt(1 + 2 * T * T);
    const double e = (3 * 2 + std::sqrt(2.0)) * T + 1 + 2 * L;
    const double ray = std::sqrt(1 + T * T) * e / q + 36 * p;
    const double back = 5 * L / q + 36 * (5 * L + p + 3) + 68;
    const double density = 15 * L + 2 * p + 7;
    // 1% for terms of second order.
    return 1.01 * u * std::max(std::sqrt(2.0) * std::max(ray, back), density);
}

} // namespace extremes
