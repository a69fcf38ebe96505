#pragma once

// The same sample as the fast path computes it: the walks and the contributions of cuda/transport/, in
// single precision, from the same random numbers. All numbers are those of the render: trace_sample
// itself passes them to a sink that keeps them.

#include "explain/sample.h"
#include "scenes/scene.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace explain {

/// What a walk does at a surface where it tries to go on.
struct FastBounce {
    bool delta;
    float pdf_fwd, pdf_rev; // sr^-1; of a delta lobe in another measure (cuda/transport/bsdf.h)
    float survival;         // the probability that roulette lets the walk go on
};

/// A vertex y_j or z_j, as Step is one of the reference. Lengths and areas are those of the reference:
/// the fast path moves the scene, and scales it by a power of two, which changes no digit.
struct FastVertex {
    ref::Vertex::Kind kind;
    std::uint32_t primitive = 0; // of `surface`
    std::string light = {};      // of `source` and `infinity`: "point light 0"
    Vec3 position{0.0};          // of `eye`, `surface` and `source`
    Vec3 normal{0.0};            // unit; of `surface`
    Vec3 towards{0.0};           // of `infinity`
    Rgb alpha{1.0};
    std::optional<double> pdf_solid_angle = {}; // as of Step, and none in the same places
    std::optional<double> pdf_area = {};
    std::optional<double> probability = {};
    std::optional<FastBounce> bounce = {};
};

/// What the vertex is on, in the words of names.h.
std::string describe(const scenes::Scene& scene, const FastVertex& vertex);

struct FastContribution {
    std::uint32_t pixel;
    int s, t;
    glm::vec3 value; // unweighted
    float weight;

    /// Not finite: left out of the picture.
    [[nodiscard]] bool is_dropped() const;
    /// What it adds to its pixel, rounded as in the picture.
    [[nodiscard]] glm::vec3 contribution() const { return weight * value; }
};

struct FastSample {
    std::vector<FastVertex> eye, light; // z_0, z_1, ... and y_0, y_1, ...
    std::vector<FastContribution> made; // in the order in which they are added up
    glm::vec3 own{0.0F};                // what the sample adds to its own pixel, splats apart

    /// The contribution of a strategy; null if there is none.
    [[nodiscard]] const FastContribution* of(int s, int t) const;
};

/// A scene in the memory of the fast path on the host.
class FastScene {
public:
    /// The scene must have a camera. Throws as fast::host_renderer.
    FastScene(const scenes::Scene& scene, int width, int height, bool roulette);
    ~FastScene();
    FastScene(const FastScene&) = delete;
    FastScene& operator=(const FastScene&) = delete;

    /// The sample `id` of the picture by `integrator`. Of the options the fast path has only seed,
    /// max_edges, and the heuristic, which is not `uniform`.
    [[nodiscard]] FastSample sample(images::Integrator integrator, const ref::PathOptions& options,
                                    const ref::SampleId& id) const;

private:
    struct InMemory;
    std::unique_ptr<InMemory> memory_;
};

} // namespace explain
