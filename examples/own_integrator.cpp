// Your own integrator, in C++, judged against a golden: a renderer of direct light from point lights on
// diffuse triangles, with its own random numbers and its own ray casting. It shares nothing with
// Plumbline's renderers but the scene's data and one interface, images::Renderer.
//   own_integrator SCENE.dae GOLDEN.exr

#include "golden/compare.h"
#include "golden/golden.h"
#include "golden/reason.h"
#include "images/renderer.h"
#include "scenes/read_scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>
#include <random>

using scenes::Rgb;
using scenes::Vec3;

/// Where a ray from `from` in direction `w` meets the triangle [Moeller and Trumbore 1997], as a
/// multiple of w; else 0.
double meet(const scenes::Triangle& triangle, const Vec3& from, const Vec3& w)
{
    const auto& v = triangle.vertices;
    const Vec3 e1 = v[1] - v[0], e2 = v[2] - v[0], p = cross(w, e2), q = cross(from - v[0], e1);
    const double det = dot(e1, p), b1 = dot(from - v[0], p) / det, b2 = dot(w, q) / det;
    return b1 >= 0 && b2 >= 0 && b1 + b2 <= 1 ? dot(e2, q) / det : 0;
}

class DirectLight : public images::Renderer {
public:
    DirectLight(const scenes::Scene& scene, int width, int height, std::uint32_t samples,
                std::uint64_t seed)
        : scene_(scene), width_(width), height_(height), samples_(samples), seed_(seed)
    {}

private:
    std::optional<images::Batch> make_batch(std::uint64_t number,
                                            const images::Monitor& /*monitor*/) override
    {
        // The same number must give the same batch, and another one independent samples.
        std::seed_seq seeds{seed_, number};
        std::mt19937_64 random(seeds);
        std::uniform_real_distribution<double> uniform;
        images::Batch batch{images::Image(width_, height_), {}, {}};
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                for (std::uint32_t i = 0; i < samples_; ++i)
                    batch.mean.at(x, y) +=
                        radiance(x + uniform(random), y + uniform(random)) / double(samples_);
        return batch;
    }

    /// The light that comes to the camera through a point of the film, in pixels from its top left
    /// corner.
    Rgb radiance(double x, double y) const
    {
        const scenes::Camera& camera = *scene_.camera;
        const int pixels = camera.fov_axis == scenes::FovAxis::horizontal ? width_ : height_;
        const double size = 2 * std::tan(camera.fov / 2) / pixels;
        const Vec3 w = (x - 0.5 * width_) * size * camera.right +
                       (0.5 * height_ - y) * size * camera.up - camera.backward;
        const scenes::Triangle* seen = nullptr;
        double nearest = INFINITY;
        for (const scenes::Triangle& triangle : scene_.triangles)
            if (const double t = meet(triangle, camera.eye, w); t > 0 && t < nearest)
                nearest = t, seen = &triangle;
        if (seen == nullptr) return Rgb(0);
        const auto* diffuse = std::get_if<scenes::Lambertian>(&scene_.materials[seen->material]);
        if (diffuse == nullptr) return Rgb(0);

        const Vec3 point = camera.eye + nearest * w;
        const auto& v = seen->vertices;
        Vec3 normal = normalize(cross(v[1] - v[0], v[2] - v[0]));
        if (dot(normal, w) > 0) normal = -normal;
        Rgb sum(0);
        for (const scenes::PointLight& light : scene_.point_lights) {
            const Vec3 to_light = light.position - point;
            const double distance2 = dot(to_light, to_light);
            const double cosine = dot(normal, to_light) / std::sqrt(distance2);
            bool blocked = cosine <= 0;
            for (const scenes::Triangle& triangle : scene_.triangles) {
                const double t = &triangle == seen ? 0 : meet(triangle, point, to_light);
                blocked |= t > 0 && t < 1;
            }
            if (!blocked)
                sum += diffuse->albedo * light.intensity * (cosine * std::numbers::inv_pi / distance2);
        }
        return sum;
    }

    const scenes::Scene& scene_;
    int width_, height_;
    std::uint32_t samples_;
    std::uint64_t seed_;
};

int main(int argc, char** argv)
try {
    if (argc != 3) throw std::invalid_argument("usage: own_integrator SCENE.dae GOLDEN.exr");
    const scenes::Scene scene = scenes::read_scene(argv[1]);
    const golden::Golden golden = golden::read_golden(argv[2]);
    // The judge asks for more samples if it suspects an error: each stage is independent of those
    // before.
    const auto render = [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
        DirectLight renderer(scene, golden.mean.width, golden.mean.height, 4, stage);
        render_batches(renderer, 0, batches, {},
                       [&](const images::Batch& batch) { candidate.add_batch(batch.mean); });
    };
    const golden::Comparison found = compare(golden, render, golden::Method::welch);
    std::cout << describe(found.verdict) << "  " << found.reason << '\n';
    return found.verdict == golden::Verdict::pass ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "own_integrator: " << error.what() << '\n';
    return 2;
}
