#include "extremes/camera/camera_case.h"

#include "extremes/wing.h"

#include "cuda/launch/probes.h"
#include "ref/transport/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

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
    return {v.x.to_double(), v.y.to_double(), v.z.to_double()};
}

/// A point of the film, in pixels from the top left corner; or a pixel, if `size` is 1.
struct FilmPlace {
    double x, y;
    double size = 0;
};

double distance_to(const FilmPlace& place, const Exact& x, const Exact& y)
{
    const auto along = [&](double from, const Exact& at) {
        return std::max(
            {0.0, (Exact(from) - at).to_double(), (at - Exact(from + place.size)).to_double()});
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

/// Wing::host or Wing::cuda.
template <Wing wing>
struct FastCamera {
    explicit FastCamera(const scenes::Camera& camera)
    {
        scenes::Scene scene;
        scene.camera = camera;
        camera_ = fast::camera_of(scene, {}, camera_pixels, camera_pixels);
    }
    [[nodiscard]] scenes::Vec3 direction(double x, double y) const
    {
        return scenes::Vec3(probed(static_cast<float>(x), static_cast<float>(y), {0, 0, 0}).direction);
    }
    [[nodiscard]] std::optional<FilmPlace> project(const scenes::Vec3& w) const
    {
        const fast::ProbedCamera found = probed(0, 0, w);
        if (!found.shown) return std::nullopt;
        const std::uint32_t row = found.pixel / camera_pixels;
        return FilmPlace{static_cast<double>(found.pixel % camera_pixels), static_cast<double>(row),
                         1.0};
    }
    [[nodiscard]] double density(const scenes::Vec3& w) const { return probed(0, 0, w).pdf_solid_angle; }

private:
    [[nodiscard]] fast::ProbedCamera probed(float x, float y, const scenes::Vec3& w) const
    {
        const fast::CameraProbe probe{camera_, x, y, fast::Vec3(w)};
        const auto compute = wing == Wing::cuda ? fast::probe_camera_on_device : fast::probe_camera;
        return compute(std::span(&probe, 1)).front();
    }

    fast::Camera camera_{};
};

/// The fast path with a field of view that was rounded to a float.
struct FastCameraOfFloats : FastCamera<Wing::host> {
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
    const Exact half = Exact(degrees) * Exact::pi() / 360;
    return {tan(half), (2 * half).to_double()};
}

FieldOfView wide_field(double less_than_180_degrees)
{
    const Exact half = Exact(less_than_180_degrees) * Exact::pi() / 360;
    return {1 / tan(half), (Exact::pi() - 2 * half).to_double()};
}

std::vector<Method> camera_methods(FieldOfView (*field)(double))
{
    std::vector<Method> methods;
    for (const Wing wing : wings()) {
        const auto add = [&](const auto& cases) {
            methods.push_back({name_of(wing), format_of(wing), cases});
        };
        if (wing == Wing::ref) add(camera_cases<RefCamera>(field));
        if (wing == Wing::host) add(camera_cases<FastCamera<Wing::host>>(field));
        if (wing == Wing::cuda) add(camera_cases<FastCamera<Wing::cuda>>(field));
    }
    methods.push_back(
        {"field of view as a float", Format::binary32, camera_cases<FastCameraOfFloats>(field)});
    return methods;
}

} // namespace extremes
