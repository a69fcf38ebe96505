#include "explain/fast_sample.h"

#include "cuda/launch/launch_samples.h"
#include "cuda/launch/renderer.h"
#include "cuda/parallel/executor.h"
#include "explain/names.h"

#include <algorithm>
#include <cmath>

namespace explain {

namespace {

// The kernel that can do everything: the abilities of a kernel change no bit (cuda/launch/renderer.h).
constexpr fast::Needs needs = fast::any_needs;
using FastView = fast::SceneView<needs>;
using Kind = ref::Vertex::Kind;

/// The walks of one sample, from the surfaces that they meet and the rays that meet none.
class Recorder {
public:
    /// `most_light`: vertices of the light walk, as `most_eye` of the eye's.
    Recorder(const FastView& scene, const fast::Placement& place, const fast::SampleId& id, int most_eye,
             int most_light, FastSample& sample)
        : scene_(scene), place_(place), square_(place.scale * place.scale), id_(id), most_eye_(most_eye),
          most_light_(most_light), sample_(sample)
    {
        FastVertex z0{Kind::eye};
        z0.position = placed(scene_.camera.eye);
        z0.probability = 1.0;
        sample_.eye.push_back(z0);
    }

    // What cuda/transport/ calls.
    void add(int s, int t, const fast::Rgb& value, float weight)
    {
        sample_.made.push_back({id_.pixel, s, t, value, weight});
        if (!sample_.made.back().is_dropped()) sample_.own += weight * value; // film_sink.h
    }
    void splat(std::uint32_t pixel, int s, const fast::Rgb& value, float weight)
    {
        sample_.made.push_back({pixel, s, 1, value, weight});
    }
    void emits(const fast::SampledEmission& emission)
    {
        const fast::Emitter& emitter = scene_.emitters[emission.emitter];
        const float pdf = fast::pdf_emission_position<needs>(emitter);
        FastVertex y0{Kind::surface};
        y0.alpha = Rgb(1.0F / pdf);
        if (fast::is_surface<needs>(emitter)) {
            set_surface(emission.end, y0);
            y0.alpha /= square_;
            y0.pdf_area = pdf * square_;
            pdf_direction_ = emission.pdf_direction;
        } else if (fast::at_infinity<needs>(emitter)) {
            y0.kind = Kind::infinity;
            y0.light = name_of_light(emitter);
            y0.towards = Vec3(emission.towards);
            (fast::can_be_hit<needs>(emitter) ? y0.pdf_solid_angle : y0.probability) = pdf;
            pdf_direction_ = std::nullopt; // per area across the ray
        } else {
            y0.kind = Kind::source;
            y0.light = name_of_light(emitter);
            y0.position = placed(emission.end.position);
            y0.probability = pdf;
            pdf_direction_ = emission.pdf_direction;
        }
        sample_.light.push_back(y0);
    }
    void meets(fast::Transport carried, const fast::WalkVertex& vertex)
    {
        const bool eye = carried == fast::Transport::radiance;
        std::vector<FastVertex>& walk = walk_of(carried, -vertex.wo);
        FastVertex next{Kind::surface};
        set_surface(vertex.point, next);
        next.alpha = eye ? Rgb(vertex.alpha) : Rgb(vertex.alpha) / square_;
        if (!delta_) next.pdf_area = vertex.pdf_area * square_;
        if (!delta_ && pdf_direction_) next.pdf_solid_angle = *pdf_direction_;
        walk.push_back(next);
        if (vertex.n + 1 < (eye ? most_eye_ : most_light_)) bounce(carried, vertex, walk.back());
    }
    void misses(fast::Transport carried, const fast::Leg& leg)
    {
        std::vector<FastVertex>& walk = walk_of(carried, leg.ray.direction);
        if (carried == fast::Transport::power || !scene_.has_environment) return;
        FastVertex last{Kind::infinity};
        last.light = name_of_light(scene_.emitters.back());
        last.towards = Vec3(leg.ray.direction);
        last.alpha = walk.size() == 1 ? Rgb(1.0) : alpha_;
        if (!delta_ && pdf_direction_) last.pdf_solid_angle = *pdf_direction_;
        walk.push_back(last);
    }

private:
    [[nodiscard]] Vec3 placed(const fast::Vec3& position) const
    {
        return Vec3(position) / place_.scale + place_.origin;
    }

    void set_surface(const fast::SurfacePoint& point, FastVertex& vertex) const
    {
        vertex.primitive = point.primitive;
        vertex.position = placed(point.position);
        vertex.normal = Vec3(point.normal);
    }

    static std::string name_of_light(const fast::Emitter& emitter)
    {
        if (emitter.kind == fast::EmitterKind::environment) return "the environment";
        return std::string(scenes::name_of(emitter.kind)) + " light " + std::to_string(emitter.index);
    }

    /// The walk to which a ray in this direction leads. The eye walk comes after the light walk.
    std::vector<FastVertex>& walk_of(fast::Transport carried, const fast::Vec3& direction)
    {
        if (carried == fast::Transport::power) return sample_.light;
        if (sample_.eye.size() == 1) {
            pdf_direction_ = scene_.camera.pdf_solid_angle(scene_.camera.cosine(direction));
            delta_ = false;
        }
        return sample_.eye;
    }

    /// The bounce at `met`, which the walk computes again in the same way (cuda/transport/subpath.h:
    /// walk, bounce), and the density of the direction in which it goes on.
    void bounce(fast::Transport carried, const fast::WalkVertex& met, FastVertex& vertex)
    {
        const bool eye = carried == fast::Transport::radiance;
        const fast::Event event = eye ? fast::Event::eye_bounce : fast::Event::light_bounce;
        const fast::Uniforms u = uniforms(id_, event, static_cast<std::uint32_t>(met.n));
        const fast::Vec3 wo_local = fast::FrameOf<float>(met.point.normal).to_local(met.wo);
        const fast::BsdfSample drawn =
            fast::sample_bsdf<needs.specular>(met.material, wo_local, u, carried);
        if (fast::is_black(drawn.value)) return;
        const float survival = fast::chance_of(met.material, met.n);
        delta_ = !fast::scatters(met.material);
        vertex.bounce = FastBounce{delta_, drawn.pdf_fwd, drawn.pdf_rev, survival};
        pdf_direction_ = drawn.pdf_fwd * survival;
        alpha_ = Rgb(met.alpha * (drawn.value / survival));
    }

    const FastView& scene_;
    const fast::Placement& place_;
    double square_; // of lengths: areas of the fast path are this times those of the reference
    const fast::SampleId& id_;
    int most_eye_, most_light_;
    FastSample& sample_;
    // Of the ray that the walk follows:
    std::optional<float> pdf_direction_; // sr^-1; none from infinity
    bool delta_ = false;
    Rgb alpha_{1.0};
};
static_assert(fast::WatchesWalks<Recorder>);

} // namespace

bool FastContribution::is_dropped() const
{
    return !fast::is_finite(value) || !std::isfinite(weight);
}

const FastContribution* FastSample::of(int s, int t) const
{
    const auto found = std::ranges::find_if(
        made, [&](const FastContribution& one) { return one.s == s && one.t == t; });
    return found == made.end() ? nullptr : &*found;
}

std::string describe(const scenes::Scene& scene, const FastVertex& vertex)
{
    if (vertex.kind == Kind::eye) return "the eye";
    return vertex.kind == Kind::surface ? describe_primitive(scene, vertex.primitive) : vertex.light;
}

/// The order of the members matters.
struct FastScene::InMemory {
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::SceneArrays arrays;
    fast::SceneInMemory scene;

    InMemory(const scenes::Scene& source, int width, int height, bool roulette)
        : arrays(fast::scene_arrays(source, roulette)),
          scene(memory, executor, arrays, fast::camera_of(source, arrays.place, width, height))
    {}
};

FastScene::FastScene(const scenes::Scene& scene, int width, int height, bool roulette)
    : memory_(std::make_unique<InMemory>(scene, width, height, roulette))
{}

FastScene::~FastScene() = default;

FastSample FastScene::sample(images::Integrator integrator, const ref::PathOptions& options,
                             const ref::SampleId& id) const
{
    using enum images::Integrator;
    const fast::PathOptions fast_options{options.seed, std::min(options.max_edges, fast::most_edges),
                                         options.heuristic};
    const fast::SampleId fast_id{id.seed, id.pixel, id.sample};
    const int capacity =
        integrator == bdpt ? fast::most_light_vertices(memory_->arrays, fast_options.max_edges) : 0;
    std::vector<fast::LightVertex> kept(static_cast<std::size_t>(capacity));
    const fast::LightVertices vertices{kept.data(), 1, capacity};
    const FastView view = memory_->scene.view<needs>();
    const int longest = fast_options.max_edges;
    FastSample sample;
    Recorder sink(view, memory_->arrays.place, fast_id, longest + 1,
                  integrator == bdpt ? std::min(longest, capacity + 1) : longest, sample);
    if (integrator == path) fast::trace_sample<needs, path>(view, fast_options, fast_id, vertices, sink);
    if (integrator == bdpt) fast::trace_sample<needs, bdpt>(view, fast_options, fast_id, vertices, sink);
    if (integrator == light)
        fast::trace_sample<needs, light>(view, fast_options, fast_id, vertices, sink);
    return sample;
}

} // namespace explain
