// Glass without eta^2.
//
// Where an eye walk goes from a medium of index n_i into one of n_t, radiance is scaled by (n_i /
// n_t)^2; the power of a light walk is not [Veach 1997, sec. 5.2]. The factors of a walk multiply to (n
// of its first edge / n of its last edge)^2. So a mistake shows only by the media in which walks begin
// and end: with n_eye at the eye, n_light at the emitter, and n_joined on the edge that joins the two
// walks,
//
//   the eye walk is not scaled               its light is (n_joined / n_eye)^2 times right
//   it is scaled by (n_t / n_i)^2            (n_joined / n_eye)^4
//   light walks are scaled like eye walks    (n_light / n_joined)^2
//
// If both ends and all surfaces that scatter are in air, all three are 1: closed glass hides the
// mistake. Media belong to a strategy, not only to the path; so its weights decide what a picture looks
// like.

#include "check/mistakes/path_mistakes.h"

#include <cmath>
#include <variant>

namespace check {

namespace {

/// The index of refraction of each edge, x_i to x_{i+1}, over that of the edge at the eye.
std::vector<double> indices(const FinishedPath& path)
{
    std::vector<double> n(path.edges(), 1.0);
    for (std::size_t i = path.edges() - 1; i > 0; --i) { // at x_i, from the eye's side to the light's
        const ref::Vertex& vertex = *path.x[i];
        n[i - 1] = n[i];
        const auto* glass = std::get_if<scenes::Glass>(&ref::material_at(path.world, vertex));
        if (glass == nullptr) continue;
        const bool from_outside =
            glm::dot(ref::direction(vertex, *path.x[i + 1]), vertex.point.normal) > 0.0;
        const bool to_outside =
            glm::dot(ref::direction(vertex, *path.x[i - 1]), vertex.point.normal) > 0.0;
        if (from_outside == to_outside) continue; // reflected
        n[i - 1] *= from_outside ? glass->ior : 1.0 / glass->ior;
    }
    return n;
}

struct Media { // relative to the eye's
    double light, joined;
};

/// The sum over strategies of `weights` times an error that depends on the media; less what is right.
PathFactor by_media(Weights weights, double (*error)(const Media&))
{
    return [=](const FinishedPath& path) {
        const std::vector<double> n = indices(path);
        double sum = -1.0;
        for (std::size_t s = 0; s <= path.edges(); ++s) {
            const double weight = weights(path, s);
            if (weight > 0.0) sum += weight * error({n[0], n[s == 0 ? 0 : s - 1]});
        }
        return sum;
    };
}

double square(double x)
{
    return x * x;
}

} // namespace

void add_refraction(Mistakes& mistakes, int longest)
{
    const auto add = [&](const std::string& is, Weights weights, double (*error)(const Media&)) {
        mistakes.add(is, up_to(longest, by_media(weights, error)));
    };
    const auto unscaled = [](const Media& n) { return square(n.joined); };
    const auto wrong_side = [](const Media& n) { return square(square(n.joined)); };
    const auto scaled_power = [](const Media& n) { return square(n.light / n.joined); };
    const std::string missing =
        "one in which radiance is not scaled by (eta_i / eta_t)^2 where an eye walk is refracted";
    const std::string swapped = "one in which radiance is scaled by (eta_t / eta_i)^2 instead of "
                                "(eta_i / eta_t)^2 where an eye walk is refracted";
    add(missing + " (bidirectional)", bidirectional, unscaled);
    add(missing + " (path tracing)", path_tracing, unscaled);
    add(swapped + " (bidirectional)", bidirectional, wrong_side);
    add(swapped + " (path tracing)", path_tracing, wrong_side);
    add("one in which the power of light walks is scaled by (eta_i / eta_t)^2 as if it were radiance",
        bidirectional, scaled_power);
}

} // namespace check
