#include "ref/transport/mis_weight.h"

#include "ref/transport/emission.h"

namespace ref {

namespace {

/// The density with which a walk that came from `previous` to `vertex` samples `next` by bounce number
/// `bounce`: per area at `next`, or per solid angle if `next` is at infinity.
double pdf_next(const World& world, const PathOptions& options, const Vertex& previous,
                const Vertex& vertex, int bounce, const Vertex& next)
{
    const auto& material = material_at(world, vertex);
    const Frame frame(vertex.point.normal);
    const Vec3 w = direction(vertex, next);
    const Vec3 wo_local = frame.to_local(direction(vertex, previous));
    const Vec3 wi_local = frame.to_local(w);
    const double pdf_solid_angle = is_delta(material)
                                       ? density_of_delta_lobe(material, wo_local, wi_local)
                                       : pdf_solid_angle_bsdf(material, wo_local, wi_local);
    const double pdf = pdf_solid_angle *
                       survival_probability(material, bounce, options.roulette, options.roulette_from);
    if (next.kind == Vertex::Kind::infinity) return pdf;
    const Vec3 d = next.point.position - vertex.point.position;
    return pdf * cosine(next, w) / glm::dot(d, d); // map: area-conversion [Veach 1997, eq. 8.10]
}

/// The density with which the ray of the camera samples x_{k-1}.
double pdf_camera(const World& world, const Vertex& eye, const Vertex& next)
{
    const Vec3 w = direction(eye, next);
    const double pdf = world.camera.pdf_solid_angle(w);
    if (next.kind == Vertex::Kind::infinity) return pdf;
    const Vec3 d = next.point.position - eye.point.position;
    return pdf * cosine(next, w) / glm::dot(d, d);
}

/// The weight of strategy s for a path of k edges by Heuristic::uniform.
double uniform_weight(std::size_t s, std::size_t k)
{
    if (k == 1) return s == 0 ? 1.0 : 0.0;
    return s == 0 ? 0.0 : 1.0 / static_cast<double>(k);
}

} // namespace

VertexDensities vertex_densities(const World& world, const PathOptions& options, const Path& x)
{
    const std::size_t k = x.size() - 1;
    VertexDensities p{std::vector<double>(k + 1, 0.0), std::vector<double>(k + 1, 0.0)};

    // The light walk makes x_0 ... x_{k-1}; it cannot hit the pinhole x_k.
    p.light[0] = pdf_emission_position(*x[0]);
    if (k >= 2) p.light[1] = pdf_area_emission_direction(world, *x[0], *x[1]);
    for (std::size_t i = 2; i < k; ++i)
        // from x_{i-1}, the walk's bounce number i - 1; map: density-light
        p.light[i] = pdf_next(world, options, *x[i - 2], *x[i - 1], static_cast<int>(i) - 1, *x[i]);

    // The eye walk makes x_k ... x_0. The pinhole has probability 1; a delta emitter cannot be hit.
    p.eye[k] = 1.0;
    p.eye[k - 1] = pdf_camera(world, *x[k], *x[k - 1]); // map: density-z1
    for (std::size_t i = 0; i + 2 <= k; ++i)
        // from x_{i+1}, the walk's bounce number k - i - 1; map: density-eye
        p.eye[i] = pdf_next(world, options, *x[i + 2], *x[i + 1], static_cast<int>(k - i) - 1, *x[i]);
    if (!can_be_hit(*x[0]->emitter)) p.eye[0] = 0.0;
    return p;
}

bool is_possible(const World& world, const Path& x, std::size_t s)
{
    const std::size_t k = x.size() - 1;
    if (s == 0) return can_be_hit(*x[0]->emitter);
    const bool light_end = s == 1 || scatters(world, *x[s - 1]);
    const bool eye_end = s == k || scatters(world, *x[s]);
    // An emitter without extent cannot be hit from the pinhole: the path has density 0 for every eye
    // walk.
    const bool seen = k > 1 || can_be_hit(*x[0]->emitter);
    return light_end && eye_end && seen;
}

std::vector<double> density_quotients(const World& world, const Path& x, const VertexDensities& p,
                                      std::size_t s)
{
    const std::size_t k = x.size() - 1;
    std::vector<double> quotients(k + 1, 1.0);
    for (std::size_t i = s; i > 0; --i)
        quotients[i - 1] = quotients[i] * (p.eye[i - 1] / p.light[i - 1]); // map: density-ratio
    for (std::size_t i = s; i < k; ++i) quotients[i + 1] = quotients[i] * (p.light[i] / p.eye[i]);
    for (std::size_t i = 0; i <= k; ++i)
        if (!is_possible(world, x, i)) quotients[i] = 0.0; // map: impossible
    return quotients;
}

double mis_weight(const World& world, const PathOptions& options, const Path& x, std::size_t s)
{
    if (!is_possible(world, x, s)) return 0.0;
    if (options.heuristic == Heuristic::uniform) return uniform_weight(s, x.size() - 1);
    const VertexDensities p = vertex_densities(world, options, x);
    for (std::size_t i = 0; i < x.size(); ++i) // no walk goes along a surface, to within rounding
        if ((i < s ? p.light[i] : p.eye[i]) == 0.0) return 0.0;
    double sum = 0.0;
    for (const double quotient : density_quotients(world, x, p, s)) // map: power [Veach 1997, sec. 9.2]
        sum += options.heuristic == Heuristic::balance ? quotient : quotient * quotient;
    return 1.0 / sum; // map: balance
}

} // namespace ref
