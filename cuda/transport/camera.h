#pragma once

// The pinhole camera: from a point of the film to a ray and back, and the importance of the film. W_e
// and its cosines are those of docs/bdpt.md, section 1. Only the product W_e cos is needed here. It is
// the density of eye walks: pdf_solid_angle.

#include "cuda/parallel/number.h"

namespace fast {

struct Camera {
    Vec3 eye;
    Vec3 right, up, backward; // orthonormal; the camera looks along -backward
    float pixel_size;         // on an image plane at distance 1
    float film_area;          // of all pixels there
    std::uint32_t width, height;

    /// The unit direction seen through the film point (x, y), in pixels from the top left corner.
    template <class F>
    [[nodiscard]] HD Vec3Of<F> direction(const F& x, const F& y) const
    {
        // map: camera-ray
        return glm::normalize((x - 0.5f * static_cast<float>(width)) * pixel_size * Vec3Of<F>(right) +
                              (0.5f * static_cast<float>(height) - y) * pixel_size * Vec3Of<F>(up) -
                              Vec3Of<F>(backward));
    }

    /// Cosine between the unit direction `w` from the eye and the viewing direction.
    template <class F>
    [[nodiscard]] HD F cosine(const Vec3Of<F>& w) const
    {
        return -glm::dot(w, Vec3Of<F>(backward));
    }

    /// Whether direction `w` from the eye is inside the picture; if so, sets `pixel` to the pixel that
    /// shows it.
    template <class F>
    [[nodiscard]] HD MaskOf<F> project(const Vec3Of<F>& w, WordOf<F>& pixel) const
    {
        const F ahead = cosine(w);
        const F scale = 1.0f / (ahead * pixel_size); // map: camera-projection
        const F x = 0.5f * static_cast<float>(width) + glm::dot(w, Vec3Of<F>(right)) * scale;
        const F y = 0.5f * static_cast<float>(height) - glm::dot(w, Vec3Of<F>(up)) * scale;
        const MaskOf<F> inside = ahead > 0.0f && x >= 0.0f && x < static_cast<float>(width) &&
                                 y >= 0.0f && y < static_cast<float>(height);
        const F column = select(inside, x, F(0.0f));
        const F row = select(inside, y, F(0.0f));
        pixel = to_word(row) * WordOf<F>(width) + to_word(column);
        return inside;
    }

    /// The density (sr^-1) with which eye walks over the whole film start in such a direction.
    template <class F>
    [[nodiscard]] HD F pdf_solid_angle(const F& cosine_w) const
    {
        return 1.0f / (film_area * cosine_w * cosine_w * cosine_w); // map: camera-density
    }
};

} // namespace fast
