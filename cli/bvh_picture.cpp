#include "cli/bvh_picture.h"

#include "ref/transport/camera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace cli {

namespace {

using ref::Vec3;

/// Hues around the circle in golden-angle steps: neighbours differ. Dark enough for a white ground.
images::Rgb color_of(std::size_t number)
{
    const double hue = 2.399963 * static_cast<double>(number);
    const auto channel = [&](double shift) { return 0.35 + 0.35 * std::cos(hue - shift); };
    return images::Rgb(channel(0), channel(2.094395), channel(4.188790));
}

/// The boxes at `level`, and of leaves that lie above it.
std::vector<ref::Aabb> boxes_at(const ref::Tree& tree, int level)
{
    struct Visit {
        std::uint32_t node;
        int depth;
    };
    std::vector<ref::Aabb> boxes;
    std::vector<Visit> visits;
    if (!tree.nodes.empty()) visits.push_back({0, 0});
    while (!visits.empty()) {
        const auto [node, depth] = visits.back();
        visits.pop_back();
        if (depth == level || tree.is_leaf(node)) {
            boxes.push_back(tree.bounds[node]);
            continue;
        }
        for (const std::uint32_t child : tree.nodes[node].children) visits.push_back({child, depth + 1});
    }
    return boxes;
}

/// Film position in pixels, and distance along the viewing direction.
struct Projected {
    glm::dvec2 film;
    double depth;
};

/// The inverse of ref::Camera::ray, for points before the eye.
std::optional<Projected> project(const scenes::Camera& camera, int width, int height, const Vec3& point)
{
    const Vec3 v = point - camera.eye;
    const double depth = -glm::dot(v, camera.backward);
    if (!(depth > 0)) return std::nullopt;
    const int pixels = camera.fov_axis == scenes::FovAxis::horizontal ? width : height;
    const double scale = pixels / (2 * std::tan(camera.fov / 2)) / depth;
    return Projected{
        {width / 2.0 + scale * glm::dot(v, camera.right), height / 2.0 - scale * glm::dot(v, camera.up)},
        depth};
}

/// A picture and, per pixel, how far along the viewing direction the scene is.
struct Canvas {
    images::Image image;
    std::vector<double> depth;
};

/// Calls `visit(pixel, ray)` with the ray through the middle of every pixel.
template <typename Visit>
void for_each_pixel(const scenes::Camera& camera, int width, int height, Visit visit)
{
    const ref::Camera pinhole(camera, width, height);
    std::size_t pixel = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) visit(pixel++, pinhole.ray({x + 0.5, y + 0.5}));
}

/// The scene by headlight, its primitives in the colours that `albedo(primitive)` gives.
template <typename Albedo>
Canvas shade(const ref::Geometry& geometry, int width, int height, Albedo albedo)
{
    const scenes::Camera& camera = *geometry.scene().camera;
    Canvas canvas{images::Image(width, height), {}};
    canvas.depth.assign(canvas.image.pixels.size(), std::numeric_limits<double>::infinity());
    for_each_pixel(camera, width, height, [&](std::size_t pixel, const ref::Ray& ray) {
        canvas.image.pixels[pixel] = images::Rgb(0.9);
        const auto hit = intersect(geometry, ray);
        if (!hit) return;
        const double cosine =
            std::abs(glm::dot(ray.direction, surface_point(geometry, ray, *hit).normal));
        canvas.image.pixels[pixel] = (0.1 + 0.9 * cosine) * albedo(hit->primitive);
        canvas.depth[pixel] = -hit->t * glm::dot(ray.direction, camera.backward);
    });
    return canvas;
}

/// Draws the segment from `a` to `b` in steps of less than a pixel.
void draw_line(Canvas& canvas, const scenes::Camera& camera, const Vec3& a, const Vec3& b,
               const images::Rgb& color)
{
    const int width = canvas.image.width;
    const int height = canvas.image.height;
    const auto start = project(camera, width, height, a);
    const auto end = project(camera, width, height, b);
    // With an end behind the eye its length on the film is not known: more than a picture's width
    // suffices.
    const double length = start && end ? glm::length(end->film - start->film) : 4.0 * (width + height);
    const int steps = 2 + static_cast<int>(2 * std::min(length, 8.0 * (width + height)));
    std::vector<bool> drawn(canvas.image.pixels.size(), false);
    for (int i = 0; i <= steps; ++i) {
        const auto at = project(camera, width, height, glm::mix(a, b, static_cast<double>(i) / steps));
        if (!at || !(at->film.x >= 0 && at->film.x < width && at->film.y >= 0 && at->film.y < height))
            continue;
        const auto pixel = static_cast<std::size_t>(at->film.y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(at->film.x);
        if (drawn[pixel]) continue; // a blend must not be repeated
        drawn[pixel] = true;
        // Boxes touch what they hold: a thousandth of the depth keeps their own surface from hiding
        // them.
        const bool hidden = at->depth > canvas.depth[pixel] * 1.001;
        canvas.image.pixels[pixel] = glm::mix(canvas.image.pixels[pixel], color, hidden ? 0.25 : 0.95);
    }
}

} // namespace

images::Image draw_boxes(const ref::Geometry& geometry, int level, int width, int height)
{
    const scenes::Camera& camera = *geometry.scene().camera;
    Canvas canvas = shade(geometry, width, height, [](std::uint32_t) { return images::Rgb(0.55); });
    std::size_t number = 0;
    for (const ref::Aabb& box : boxes_at(geometry.tree(), level)) {
        const images::Rgb color = color_of(number++);
        const auto corner = [&](int bits) {
            return Vec3((bits & 1) != 0 ? box.upper.x : box.lower.x,
                        (bits & 2) != 0 ? box.upper.y : box.lower.y,
                        (bits & 4) != 0 ? box.upper.z : box.lower.z);
        };
        for (int bits = 0; bits < 8; ++bits)
            for (const int axis : {1, 2, 4})
                if ((bits & axis) == 0)
                    draw_line(canvas, camera, corner(bits), corner(bits | axis), color);
    }
    return canvas.image;
}

images::Image draw_order(const ref::Geometry& geometry, std::size_t pieces, int width, int height)
{
    const std::vector<std::uint32_t>& order = geometry.tree().primitives;
    std::vector<std::size_t> piece(order.size());
    for (std::size_t place = 0; place < order.size(); ++place)
        piece[order[place]] = place * pieces / order.size();
    return shade(geometry, width, height,
                 [&](std::uint32_t primitive) { return color_of(piece[primitive]); })
        .image;
}

images::Image draw_visits(const ref::Geometry& geometry, double most, int width, int height)
{
    images::Image image(width, height);
    for_each_pixel(*geometry.scene().camera, width, height, [&](std::size_t pixel, const ref::Ray& ray) {
        ref::TraversalCounts counts;
        intersect(geometry, ray, &counts);
        const double x = 3 * static_cast<double>(counts.nodes) / most;
        image.pixels[pixel] = glm::clamp(images::Rgb(x, x - 1, x - 2), 0.0, 1.0);
    });
    return image;
}

} // namespace cli
