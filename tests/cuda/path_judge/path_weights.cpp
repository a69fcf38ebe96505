// Weights of joined paths, and bounds on their errors.
//
// The weight of strategy s is 1 / sum_j p_j / p_s. Each quotient is a product of densities. In these,
// every cosine of the path, at a vertex along an edge, occurs at most twice: in the density of that
// vertex, and in that of the edge's other end. A cosine c with an error of e has a relative error of e
// / c. Distances, constants and products count 24 roundings per vertex. For a delta lobe, Fresnel's
// reflectance takes the place of a density, once from either side; its variation is found by varying
// the cosines. Let E be the sum of all these relative errors. No quotient has a larger relative error,
// nor has their sum, since all terms are positive. With w = 1 / (1 + x), dw = w (1 - w) dx / x: the
// error of the weight is at most w (1 - w) E, twice that for the power heuristic, plus the error of
// the running sums (running_sums_test.cpp).

#include "tests/cuda/path_judge/judged_paths.h"
#include "tests/cuda/path_judge/path_rounding.h"

#include "ref/transport/emission.h"

namespace path_judge_test {

namespace {

using ref::Vec3;
using ref::Vertex;

/// Beyond this error, the first order is not accurate enough.
constexpr double worst_quotient = 0.1;

/// The relative error of a delta lobe's factor from wo to wi, where either cosine may have an error.
double lobe_error(const scenes::Material& material, Vec3 wo, double wo_error, Vec3 wi, double wi_error)
{
    const double middle = ref::density_of_delta_lobe(material, wo, wi);
    if (!(middle > 0)) return 1;
    double worst = 0;
    const Vec3 exact_o = wo;
    const Vec3 exact_i = wi;
    for (const double o : {-wo_error, 0.0, wo_error})
        for (const double i : {-wi_error, 0.0, wi_error}) {
            wo.z = std::clamp(exact_o.z + o, -1.0, 1.0);
            wi.z = exact_i.z + i;
            worst = std::max(worst, std::abs(ref::density_of_delta_lobe(material, wo, wi) - middle));
        }
    return worst / middle + 16 * roundoff;
}

/// The weight of one of the two strategies of path tracing: densities per solid angle.
double balanced(double pdf, double pdf_other)
{
    return pdf / (pdf + pdf_other);
}

} // namespace

PathJudge::JoinedPath PathJudge::join(std::size_t s, std::size_t t) const
{
    JoinedPath x;
    for (std::size_t i = 0; i < s; ++i) {
        x.vertices.push_back(&y_.vertices[i]);
        if (i > 0) x.turned.push_back(y_.turned[i]);
    }
    if (s > 0) x.turned.push_back(0);
    for (std::size_t i = t; i > 0; --i) {
        x.vertices.push_back(&z_.vertices[i - 1]);
        if (i > 1) x.turned.push_back(z_.turned[i - 1]);
    }
    return x;
}

double PathJudge::quotient_error(const JoinedPath& x) const
{
    double error = 0;
    const std::size_t k = x.vertices.size() - 1;
    for (std::size_t i = 0; i <= k; ++i) {
        error += 24 * roundoff;
        const Vertex& vertex = *x.vertices[i];
        if (vertex.kind == Vertex::Kind::eye) {
            const Vec3 w = direction(vertex, *x.vertices[k - 1]);
            error += 6 * (x.turned[k - 1] + cosine_error) / setting_.world.camera.cosine(w);
        }
        if (vertex.kind == Vertex::Kind::source && vertex.emitter->kind == ref::EmitterKind::spot) {
            const auto& light = setting_.world.scene.spot_lights[vertex.emitter->index];
            const double cosine = glm::dot(light.direction, direction(vertex, *x.vertices[1]));
            if (std::abs(cosine - light.cos_cutoff) <= x.turned[0] + spot_cosine_error(cosine))
                throw Undecided("the rim of a spot");
        }
        if (vertex.kind != Vertex::Kind::surface) continue;
        const auto cosine_towards = [&](std::size_t neighbour, double turned) {
            const double e = turned + cosine_error + (i == 0 ? x.normal_error : 0);
            error += 2 * e / cosine(vertex, direction(vertex, *x.vertices[neighbour]));
            return e;
        };
        const double ahead = i < k ? cosine_towards(i + 1, x.turned[i]) : 0;
        const double behind = i > 0 ? cosine_towards(i - 1, x.turned[i - 1]) : 0;
        const auto& material = material_at(setting_.world, vertex);
        if (i == 0 || !ref::is_delta(material)) continue;
        const ref::Frame frame(vertex.point.normal);
        const Vec3 to_light = frame.to_local(direction(vertex, *x.vertices[i - 1]));
        const Vec3 to_eye = frame.to_local(direction(vertex, *x.vertices[i + 1]));
        error += lobe_error(material, to_light, behind, to_eye, ahead) +
                 lobe_error(material, to_eye, ahead, to_light, behind);
    }
    return error;
}

double PathJudge::path_tracing_weight(const JoinedPath& x, std::size_t s) const
{
    // x_1 bounced to x_0, or was joined to x_0.
    const ref::World& world = setting_.world;
    const Vertex& light = *x.vertices[0];
    const Vertex& last = *x.vertices[1];
    if (last.kind == Vertex::Kind::eye || !scatters(world, last) || !ref::can_be_hit(*light.emitter))
        return 1;
    const ref::Frame frame(last.point.normal);
    const auto& material = material_at(world, last);
    const int bounce = static_cast<int>(x.vertices.size()) - 2;
    const double by_hit =
        ref::pdf_solid_angle_bsdf(material, frame.to_local(direction(last, *x.vertices[2])),
                                  frame.to_local(direction(last, light))) *
        ref::survival_probability(material, bounce, setting_.options.roulette,
                                  setting_.options.roulette_from);
    const double by_event =
        light.kind == Vertex::Kind::infinity
            ? pdf_solid_angle_environment(world.emitters)
            : pdf_solid_angle_incident(world.emitters, last.point.position, light.point);
    return s == 0 ? balanced(by_hit, by_event) : balanced(by_event, by_hit);
}

void PathJudge::weigh(const JoinedPath& x, std::size_t s, ExpectedContribution& expected) const
{
    expected.weight_error = 0;
    expected.weight = 1;
    if (integrator_ == fast::Integrator::light) return;
    const bool power =
        integrator_ == fast::Integrator::bdpt && setting_.options.heuristic == ref::Heuristic::power;
    const double error = quotient_error(x) * (power ? 2 : 1);
    const double w = integrator_ == fast::Integrator::path
                         ? path_tracing_weight(x, s)
                         : mis_weight(setting_.world, setting_.options, x.vertices, s);
    const auto vertices = static_cast<double>(x.vertices.size());
    expected.weight = w;
    expected.weight_error = error <= worst_quotient
                                ? 1.1 * w * (1 - w) * error + (7 * vertices + 8) * roundoff * w
                                : std::numeric_limits<double>::infinity();
}

} // namespace path_judge_test
