#pragma once

// The pinhole camera: from a point of the film to a ray.

#include "ref/trees/ray.h"
#include "scenes/scene.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>

namespace ref {

/// A scene's camera for pictures of `width` x `height` square pixels.
class Camera {
public:
    Camera(const scenes::Camera& camera, int width, int height)
        : camera_(camera), width_(width), height_(height)
    {
        // The field of view spans the picture along one axis; square pixels give the other.
        const double tan_half = std::tan(camera.fov / 2.0);
        const int pixels = camera.fov_axis == scenes::FovAxis::horizontal ? width : height;
        pixel_size_ = 2.0 * tan_half / pixels;
    }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// The ray through the film point (x, y), in pixels from the top left corner of the picture.
    /// Its direction has unit length.
    [[nodiscard]] Ray ray(const glm::dvec2& film) const
    {
        const double x = (film.x - width_ / 2.0) * pixel_size_;
        const double y = (height_ / 2.0 - film.y) * pixel_size_;
        return {camera_.eye, glm::normalize(x * camera_.right + y * camera_.up - camera_.backward)};
    }

private:
    scenes::Camera camera_;
    int width_;
    int height_;
    double pixel_size_; // on an image plane at distance 1
};

} // namespace ref
