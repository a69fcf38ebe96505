#pragma once

// The pinhole camera: from a point of the film to a ray and back, and the importance of the film.
//
// The value of a pixel is the mean radiance over the pixel. As a measurement of the light that reaches
// the pinhole [Veach 1997, sec. 8.2], its importance is W_e = 1 / (A cos^4) for a film of area A at
// distance 1, times the number of pixels, on the pixel itself, and 0 elsewhere. The cosine is that
// between the ray and the viewing direction, which is the normal of the pinhole. Three of its powers
// come from the solid angle of a piece of the film; the fourth cancels the cosine of the geometric
// term G at the pinhole.
//
// That cosine of G is Camera::cosine. The vertex at the eye has no normal, so geometric_term
// (vertex.h) has no cosine there, and light_image (connect.cpp) multiplies G by it and by W_e. Their
// product is pdf_solid_angle, the density of eye walks; therefore eye walks begin with weight 1.
//
// There are as many light walks as eye walks over the whole film, so the number of pixels cancels: the
// contribution of a light walk to a pixel is divided only by the samples per pixel.

#include "ref/trees/ray.h"
#include "scenes/scene.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <optional>

namespace ref {

/// The camera of a scene, for pictures of `width` x `height` square pixels.
class Camera {
public:
    Camera(const scenes::Camera& camera, int width, int height)
        : camera_(camera), width_(width), height_(height)
    {
        // The field of view is given along one axis; since pixels are square, the other axis follows.
        const double tan_half = std::tan(camera.fov / 2.0);
        const int pixels = camera.fov_axis == scenes::FovAxis::horizontal ? width : height;
        pixel_size_ = 2.0 * tan_half / pixels;
    }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const Vec3& eye() const { return camera_.eye; }

    /// The ray through the film point (x, y), in pixels from the top left corner of the picture.
    /// Its direction has unit length.
    [[nodiscard]] Ray ray(const glm::dvec2& film) const
    {
        const double x = (film.x - width_ / 2.0) * pixel_size_;
        const double y = (height_ / 2.0 - film.y) * pixel_size_;
        // map: camera-ray
        return {camera_.eye, glm::normalize(x * camera_.right + y * camera_.up - camera_.backward)};
    }

    /// The film point that is seen in direction `w` from the eye; nullopt outside the picture.
    [[nodiscard]] std::optional<glm::dvec2> project(const Vec3& w) const
    {
        const double ahead = -glm::dot(w, camera_.backward);
        if (ahead <= 0.0) return std::nullopt;
        // map: camera-projection
        const glm::dvec2 film(width_ / 2.0 + glm::dot(w, camera_.right) / ahead / pixel_size_,
                              height_ / 2.0 - glm::dot(w, camera_.up) / ahead / pixel_size_);
        const bool seen = film.x >= 0.0 && film.x < width_ && film.y >= 0.0 && film.y < height_;
        return seen ? std::optional(film) : std::nullopt;
    }

    /// Cosine between the unit direction `w` from the eye and the viewing direction.
    [[nodiscard]] double cosine(const Vec3& w) const { return -glm::dot(w, camera_.backward); }

    /// W_e (sr^-1) towards a unit direction within the picture; see the top of the file.
    [[nodiscard]] double importance(const Vec3& w) const
    {
        return 1.0 / (film_area() * std::pow(cosine(w), 4)); // map: importance [Veach 1997, sec. 8.2]
    }

    /// The density (sr^-1) with which eye walks over the whole film start in such a direction.
    [[nodiscard]] double pdf_solid_angle(const Vec3& w) const
    {
        return 1.0 / (film_area() * std::pow(cosine(w), 3)); // map: camera-density
    }

private:
    [[nodiscard]] double film_area() const { return width_ * pixel_size_ * height_ * pixel_size_; }

    scenes::Camera camera_;
    int width_;
    int height_;
    double pixel_size_; // on an image plane at distance 1
};

} // namespace ref
