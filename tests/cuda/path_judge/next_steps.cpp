// The bounce: the reference's next step from a vertex of the fast path.

#include "tests/cuda/path_judge/followed_walk.h"
#include "tests/cuda/path_judge/path_rounding.h"

namespace path_judge_test {

namespace {

using ref::Vec3;

/// The error of the direction of `sample`.
double error_of(const scenes::Material& material, const Vec3& wo, const ref::BsdfSample& sample)
{
    const auto* glass = std::get_if<scenes::Glass>(&material);
    if (glass == nullptr || wo.z * sample.wi_local.z > 0) return direction_error;
    const double eta = wo.z > 0 ? 1 / glass->ior : glass->ior;
    return refraction_error(eta, std::abs(sample.wi_local.z));
}

/// Whether the number that chooses the lobe is within rounding of the reflectance.
bool lobe_is_close(const scenes::Material& material, const Vec3& wo, double u_lobe)
{
    const auto* glass = std::get_if<scenes::Glass>(&material);
    if (glass == nullptr) return false;
    const double eta_i = wo.z > 0 ? 1 : glass->ior;
    const double eta_t = wo.z > 0 ? glass->ior : 1;
    double cos_t = 0;
    const double cos_i = std::abs(wo.z);
    return std::abs(u_lobe - ref::fresnel(cos_i, eta_i, eta_t, cos_t)) <=
           fresnel_error(cos_i, cosine_error, eta_i, eta_t);
}

} // namespace

std::vector<NextStep> next_steps(const Setting& setting, ref::Transport carried,
                                 const fast::WalkVertex& vertex, const NextStep& last)
{
    const ref::SurfacePoint point = surface_of(setting.world, vertex.point);
    const auto& material = setting.world.scene.materials[point.material];
    const bool eye = carried == ref::Transport::radiance;
    ref::Uniforms u = float_uniforms(setting.id, eye ? ref::Event::eye_bounce : ref::Event::light_bounce,
                                     static_cast<std::uint32_t>(vertex.n));
    const ref::Frame frame(point.normal);
    const Vec3 wo = frame.to_local(Vec3(vertex.wo));
    if (std::abs(wo.z) <= cosine_error) throw Undecided("the side that a walk comes from");
    const double survival = ref::survival_probability(material, vertex.n, setting.options.roulette,
                                                      setting.options.roulette_from);
    if (survival < 1 && std::abs(u[3] - survival) <= roundoff) throw Undecided("roulette");
    if (u[3] >= survival) return {};

    std::vector<NextStep> steps;
    const auto add = [&] {
        const ref::BsdfSample sample = sample_bsdf(material, wo, u, carried);
        if (sample.value == ref::Rgb(0)) return;
        const Vec3 wi = glm::normalize(frame.to_world(sample.wi_local));
        const double clearance = vertex.point.clearance;
        const double side = glm::dot(wi, point.normal) < 0 ? -1 : 1;
        // Value, eta, survival, quotient and product.
        steps.push_back({point.position + side * clearance * point.normal,
                         4 * roundoff * (glm::length(point.position) + clearance), wi,
                         error_of(material, wo, sample), last.alpha * sample.value / survival,
                         last.alpha_error + 8 * roundoff});
    };
    add();
    if (lobe_is_close(material, wo, u[2])) {
        for (const double lobe : {0.0, 1 - 0x1p-53}) {
            u[2] = lobe;
            add();
        }
    }
    return steps;
}

} // namespace path_judge_test
