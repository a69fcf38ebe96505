#include "explain/view.h"

#include "scenes/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace explain {

namespace {

constexpr int corners = 48; // of the polygon that stands for a circle

/// The circle of radius `radius` around `center`, in the plane of two orthonormal directions.
std::vector<Vec3> circle(const Vec3& center, double radius, const Vec3& x, const Vec3& y)
{
    std::vector<Vec3> points;
    for (int i = 0; i < corners; ++i) {
        const double phi = 2.0 * std::numbers::pi * i / corners;
        points.push_back(center + radius * (std::cos(phi) * x + std::sin(phi) * y));
    }
    return points;
}

/// The axis, 0 to 2, along which `v` is longest.
int main_axis(const Vec3& v)
{
    const Vec3 a = glm::abs(v);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

/// The parallel projection along an axis, with `right` and `up` on the panel.
View parallel_view(const std::string& title, const Vec3& right, const Vec3& up,
                   const std::vector<Vec3>& points, double height)
{
    glm::dvec2 lower(std::numeric_limits<double>::infinity());
    glm::dvec2 upper = -lower;
    for (const Vec3& p : points) {
        const glm::dvec2 at(glm::dot(p, right), -glm::dot(p, up));
        lower = glm::min(lower, at);
        upper = glm::max(upper, at);
    }
    const glm::dvec2 size = upper - lower;
    const double border = 24.0; // for the names of vertices
    // At most twice as wide as high; a scene without extent is a point.
    const double largest = std::max({size.y, size.x / 2.0, 1e-300});
    const double scale = (height - 2.0 * border) / largest;
    const double width = std::max(height / 2.0, size.x * scale + 2.0 * border);
    const glm::dvec2 middle = 0.5 * (lower + upper);
    const auto at = [=](const Vec3& p) {
        const glm::dvec2 q(glm::dot(p, right), -glm::dot(p, up));
        return scale * (q - middle) + 0.5 * glm::dvec2(width, height);
    };
    return {title, width, height,
            [=](const Vec3& a, const Vec3& b) {
                return std::optional(Line{at(a), at(b)});
            },
            [=](const Vec3& center, double radius) {
                std::vector<glm::dvec2> outline;
                for (const Vec3& p : circle(center, radius, right, up)) outline.push_back(at(p));
                return outline;
            }};
}

Vec3 unit(int axis, double sign)
{
    Vec3 v(0.0);
    v[axis] = sign;
    return v;
}

} // namespace

View camera_view(const ref::World& world, double height)
{
    const scenes::Camera camera = *world.scene.camera;
    const double scale = height / world.camera.height(); // panel pixels per pixel of the picture
    const double width = world.camera.width() * scale;
    const int pixels =
        camera.fov_axis == scenes::FovAxis::horizontal ? world.camera.width() : world.camera.height();
    const double unit_plane = scale * pixels / (2.0 * std::tan(camera.fov / 2.0));
    const double near = 1e-3 * std::max(world.geometry.diagonal(), 1e-3);
    const auto ahead = [=](const Vec3& p) { return -glm::dot(p - camera.eye, camera.backward); };
    const auto at = [=](const Vec3& p) {
        const Vec3 d = p - camera.eye;
        return glm::dvec2(width / 2.0 + unit_plane * glm::dot(d, camera.right) / ahead(p),
                          height / 2.0 - unit_plane * glm::dot(d, camera.up) / ahead(p));
    };
    const auto line = [=](Vec3 a, Vec3 b) -> std::optional<Line> {
        if (ahead(a) < near && ahead(b) < near) return std::nullopt;
        const auto clip = [&](Vec3& inside, Vec3& p) { // moves p to the plane in front of the eye
            if (ahead(p) < near)
                p = inside + (p - inside) * ((ahead(inside) - near) / (ahead(inside) - ahead(p)));
        };
        clip(b, a);
        clip(a, b);
        return Line{at(a), at(b)};
    };
    const auto outline = [=](const Vec3& center, double radius) {
        std::vector<glm::dvec2> points;
        const Vec3 d = center - camera.eye;
        const double distance2 = glm::dot(d, d);
        if (distance2 <= radius * radius) return points;
        // The circle in which the lines from the eye touch the ball.
        const double ratio = radius * radius / distance2;
        const ref::Frame frame(glm::normalize(d));
        for (const Vec3& p :
             circle(center - ratio * d, radius * std::sqrt(1.0 - ratio), frame.x, frame.y)) {
            if (ahead(p) < near) return std::vector<glm::dvec2>();
            points.push_back(at(p));
        }
        return points;
    };
    return {"camera", width, height, line, outline};
}

std::vector<View> parallel_views(const ref::World& world, const std::vector<Vec3>& points, double height)
{
    const scenes::Camera& camera = *world.scene.camera;
    std::vector<Vec3> all = points;
    all.push_back(camera.eye);
    if (const auto box = scenes::bounds(world.scene)) {
        all.push_back(box->min);
        all.push_back(box->max);
    }
    const int up = main_axis(camera.up);
    Vec3 rest = camera.right;
    rest[up] = 0.0;
    const int right = main_axis(rest);
    const int ahead = 3 - up - right;
    const auto side = [](double x) { return x < 0.0 ? -1.0 : 1.0; };
    const Vec3 to_right = unit(right, side(camera.right[right]));
    const Vec3 to_up = unit(up, side(camera.up[up]));
    const Vec3 to_ahead = unit(ahead, side(-camera.backward[ahead]));
    return {parallel_view("from above", to_right, to_ahead, all, height),
            parallel_view("from the side", to_ahead, to_up, all, height)};
}

} // namespace explain
