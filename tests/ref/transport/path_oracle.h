#pragma once

// The contribution of a path and the density of each strategy, computed from the definitions and the
// scene alone: slow, and without any code of ref/. There is no convention for delta vertices: a run of
// them between two other vertices is one map from directions at one end to positions at the other, and
// its Jacobian is computed by propagating derivatives along the rays [Igehy 1999].

#include "scenes/scene.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <vector>

namespace transport_test {

using scenes::Rgb;
using scenes::Vec3;

/// The position of a path vertex, and nothing else.
struct Place {
    enum class Kind { eye, surface, point, spot, directional, environment };
    Kind kind;
    Vec3 position;       // for a directional light or the environment, the unit direction towards it
    std::uint32_t index; // of the primitive or light, among all primitives or the lights of its kind
};

/// x_0 (on the emitter) to x_k (the eye).
using Places = std::vector<Place>;

/// Whether the place is infinitely far away: a direction.
inline bool is_infinite(const Place& place)
{
    return place.kind == Place::Kind::directional || place.kind == Place::Kind::environment;
}

/// The unit direction from a to b; at most one of them is infinitely far away.
inline Vec3 towards(const Place& a, const Place& b)
{
    if (is_infinite(b)) return b.position;
    if (is_infinite(a)) return -a.position;
    return glm::normalize(b.position - a.position);
}

struct Judgement {
    /// f(x) [Veach 1997, eq. 8.7], for the mean radiance over a picture of one pixel: per solid angle of
    /// x_0 at infinity, per area of every vertex that is on a surface and not delta.
    Rgb throughput;
    /// p_s(x) in the same measure for s = 0 ... k: the density of the path for an eye walk and a light
    /// walk.
    std::vector<double> densities;
    /// An upper bound on the magnification of the rounding of the positions in these numbers.
    double condition;
};

/// The six kinds of emitters, and their selection probabilities.
struct Share {
    Place::Kind kind;
    std::uint32_t index;
    double area; // m^2, of a surface
    double probability;
};

class PathOracle {
public:
    /// `roulette_from`: the first bounce that roulette may end.
    PathOracle(const scenes::Scene& scene, int width, int height, bool roulette, int roulette_from = 5);

    /// Whether a light walk and an eye walk can be joined between x_{s-1} and x_s; for s = 0, whether
    /// the eye walk can hit x_0.
    [[nodiscard]] bool can_join(const Places& x, std::size_t s) const;
    /// Evaluates a path whose delta vertices reflect or refract, so that some strategy can make it.
    [[nodiscard]] Judgement judge(const Places& x) const;
    [[nodiscard]] const std::vector<Share>& shares() const { return shares_; }

    enum class Answer { no, yes, undecided };
    /// Whether a surface lies between two places that are joined; unknown within 1e-9 of an edge.
    [[nodiscard]] Answer blocked(const Place& a, const Place& b) const;
    /// The pixel in which the eye sees the place, y * width + x, or -1; unknown (-2) within 1e-9 of an
    /// edge.
    [[nodiscard]] int pixel_of(const Place& place) const;

private:
    [[nodiscard]] bool is_delta(const Place& place) const;
    [[nodiscard]] bool scatters(const Place& place) const;
    [[nodiscard]] const scenes::Material& material(const Place& place) const;
    [[nodiscard]] Vec3 normal(const Place& place) const;
    [[nodiscard]] Share share_of(const Place& place) const;
    [[nodiscard]] double survival(const Place& place, std::size_t bounce) const;
    [[nodiscard]] Rgb emitted(const Place& x0, const Vec3& w) const;
    [[nodiscard]] double pdf_start(const Place& x0, const Vec3& w) const;
    struct Jacobian {
        double value;     // d xi_a / d xi_b
        double condition; // the growth of roundoff from a to b
    };
    [[nodiscard]] Jacobian jacobian(const Places& walk, std::size_t a, std::size_t b) const;
    [[nodiscard]] double fresnel_at(const Places& walk, std::size_t i) const;
    [[nodiscard]] bool same_side(const Places& walk, std::size_t i) const;
    [[nodiscard]] double walk_density(const Places& walk, std::size_t vertices, bool from_eye) const;
    [[nodiscard]] double eye_cosine(const Vec3& w) const;

    const scenes::Scene& scene_;
    int width_, height_;
    bool roulette_;
    int roulette_from_;
    double tan_x_, tan_y_; // of half the picture
    double radius_;        // of the ball around the scene's box
    std::vector<Share> shares_;
};

} // namespace transport_test
