#include "ref/transport/mis_weight.h"

#include "ref/transport/emission.h"

namespace ref {

namespace {

/// The density with which a walk that came from `previous` to `vertex`, its `bounce`-th bounce, makes
/// `next`: per area at `next`, or per solid angle if that is at infinity.
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
    const double pdf = pdf_solid_angle * survival_probability(material, bounce, options.roulette);
    if (next.kind == Vertex::Kind::infinity) return pdf;
    const Vec3 d = next.point.position - vertex.point.position;
    return pdf * cosine(next, w) / glm::dot(d, d); // [Veach 1997, eq. 8.10]
}

/// The density of x_{k-1}, which the camera's ray finds.
double pdf_camera(const World& world, const Vertex& eye, const Vertex& next)
{
    const Vec3 w = direction(eye, next);
    const double pdf = world.camera.pdf_solid_angle(w);
    if (next.kind == Vertex::Kind::infinity) return pdf;
    const Vec3 d = next.point.position - eye.point.position;
    return pdf * cosine(next, w) / glm::dot(d, d);
}

} // namespace

VertexDensities vertex_densities(const World& world, const PathOptions& options, const Path& x)
{
    const std::size_t k = x.size() - 1;
    VertexDensities p{std::vector<double>(k + 1, 0.0), std::vector<double>(k + 1, 0.0)};

    // The light walk makes x_0 ... x_{k-1}; the pinhole x_k it never meets.
    p.light[0] = pdf_emission_position(*x[0]);
    if (k >= 2) p.light[1] = pdf_area_emission_direction(world, *x[0], *x[1]);
    for (std::size_t i = 2; i < k; ++i) // from x_{i-1}, the walk's bounce number i - 1
        p.light[i] = pdf_next(world, options, *x[i - 2], *x[i - 1], static_cast<int>(i) - 1, *x[i]);

    // The eye walk makes x_k ... x_0; the pinhole is certain. A delta emitter it never meets.
    p.eye[k] = 1.0;
    p.eye[k - 1] = pdf_camera(world, *x[k], *x[k - 1]);
    for (std::size_t i = 0; i + 2 <= k; ++i) // from x_{i+1}, the walk's bounce number k - i - 1
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
    // A pinhole sees no emitter without extent: the path has density zero for every eye walk.
    const bool seen = k > 1 || can_be_hit(*x[0]->emitter);
    return light_end && eye_end && seen;
}

std::vector<long double> strategy_densities(const World& world, const PathOptions& options,
                                            const Path& x)
{
    const std::size_t k = x.size() - 1;
    const VertexDensities p = vertex_densities(world, options, x);
    std::vector<long double> densities;
    for (std::size_t s = 0; s <= k; ++s) {
        long double density = is_possible(world, x, s) ? 1.0L : 0.0L;
        for (std::size_t i = 0; i <= k; ++i) density *= i < s ? p.light[i] : p.eye[i];
        densities.push_back(density);
    }
    return densities;
}

double mis_weight(const World& world, const PathOptions& options, const Path& x, std::size_t s)
{
    const std::vector<long double> p = strategy_densities(world, options, x);
    if (p[s] == 0.0L) return 0.0;
    long double sum = 0.0L;
    for (const long double p_i : p) {
        const long double ratio = p_i / p[s];
        sum += options.heuristic == Heuristic::balance ? ratio : ratio * ratio; // [Veach 1997, sec. 9.2]
    }
    return static_cast<double>(1.0L / sum);
}

} // namespace ref
