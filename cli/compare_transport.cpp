#include "cli/compare_transport.h"

#include "check/mistakes/explanations.h"
#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "golden/camera_faults.h"
#include "golden/explain.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

namespace cli {

namespace {

/// Renders of the golden's scene, with options like those of the golden.
class SceneRenders {
public:
    SceneRenders(const golden::Golden& golden, double samples, const CompareCommand& options)
        : command_(render_of(golden, options.scene)),
          scene_(load_scene(options.scene, command_.frame, options.quiet))
    {
        if (scene_.hash != value_of(golden.metadata, "scene_hash"))
            throw std::invalid_argument("--scene " + options.scene +
                                        ": is not the scene of the golden (" +
                                        value_of(golden.metadata, "scene") + ")");
        // For each render some 5 seconds of one processor core.
        constexpr double most_samples = 1 << 21;
        const double wanted = samples > 0.0 ? samples : static_cast<double>(command_.samples);
        const double per_pixel =
            std::min(wanted, most_samples / static_cast<double>(golden.mean.pixels.size()));
        command_.samples = whole_batches(per_pixel);
        command_.threads = options.threads;
        command_.quiet = options.quiet;
        command_.device = "host"; // ten times as fast as the reference
        ++command_.seed;          // other noise than the golden's
    }

    [[nodiscard]] const RenderCommand& command() const { return command_; }
    [[nodiscard]] const scenes::Scene& scene() const { return scene_; }

    /// The golden's scene as `scene` with other options.
    images::Image picture(const RenderCommand& command, const scenes::Scene& scene) const
    {
        const Size size = parse_size(command.size);
        images::Film film(size.width, size.height);
        render(command, scene, [&](const images::Batch& batch) { film.add_batch(batch.mean); });
        return film.mean();
    }

    [[nodiscard]] std::uint64_t whole_batches(double samples) const
    {
        return command_.batch_size *
               static_cast<std::uint64_t>(std::max(2.0, std::ceil(samples / command_.batch_size)));
    }

private:
    static void render(const RenderCommand& command, const scenes::Scene& scene,
                       const std::function<void(const images::Batch&)>& add)
    {
        const std::uint64_t batches = command.samples / command.batch_size;
        Progress progress(scene.name + ", another camera", 0.0, static_cast<double>(batches),
                          command.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const auto renderer = renderer_for(command, scene);
        if (!render_batches(*renderer, 0, batches, monitor, add)) throw Interrupted();
    }

    RenderCommand command_;
    scenes::Scene scene_;
};

std::vector<golden::Fault> half_pixel(const SceneRenders& renders)
{
    RenderCommand command = renders.command();
    const Size size = parse_size(command.size);
    command.size = std::to_string(2 * size.width) + "x" + std::to_string(2 * size.height);
    command.samples = renders.whole_batches(static_cast<double>(command.samples) / 4.0);
    return golden::half_pixel_faults(renders.picture(command, renders.scene()));
}

/// `right`: the golden's mean. Its noise is in the comparison anyway, that of a further render would not
/// be.
std::vector<golden::Fault> field_of_view(const SceneRenders& renders, const images::Image& right)
{
    if (right.width == right.height) return {};
    scenes::Scene scene = renders.scene();
    const bool vertical = scene.camera->fov_axis == scenes::FovAxis::vertical;
    scene.camera->fov_axis = vertical ? scenes::FovAxis::horizontal : scenes::FovAxis::vertical;
    const std::string is =
        vertical ? "one in which the vertical field of view was taken for the horizontal one"
                 : "one in which the horizontal field of view was taken for the vertical one";
    const images::Image wrong = renders.picture(renders.command(), scene);
    return {golden::rendered_fault(is, wrong, right), golden::ratio_fault(is, wrong)};
}

/// The mistakes of light transport, rendered until golden::explain is certain.
class TransportMistakes {
public:
    TransportMistakes(const SceneRenders& renders, const golden::Golden& golden,
                      const std::vector<images::Image>& pictures, double samples)
        : golden_(golden), pictures_(pictures), samples_(samples), name_(renders.scene().name),
          quiet_(renders.command().quiet),
          explanations_(renders.scene(), golden.mean.width, golden.mean.height,
                        {.seed = renders.command().seed,
                         .max_edges = renders.command().max_edges,
                         .roulette = !renders.command().no_roulette},
                        renders.command().threads)
    {}

    std::string explain()
    {
        images::Film film(golden_.mean.width, golden_.mean.height);
        for (const images::Image& picture : pictures_) film.add_batch(picture);
        return golden::explain(golden_, pictures_, samples_, [&] { return more(film.mean()); });
    }

private:
    std::vector<golden::Explanation> more(const images::Image& mean)
    {
        ++look_;
        Progress progress(name_ + ", mistakes of light transport, look " + std::to_string(look_), 0.0,
                          static_cast<double>(explanations_.next_batches()), quiet_);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const bool rendered = explanations_.render(monitor);
        if (interrupt_requested()) throw Interrupted();
        return rendered ? explanations_.explanations(mean, golden_.mean)
                        : std::vector<golden::Explanation>();
    }

    const golden::Golden& golden_;
    const std::vector<images::Image>& pictures_;
    double samples_;
    std::string name_;
    bool quiet_;
    int look_ = 0;
    check::SceneExplanations explanations_;
};

} // namespace

SceneMistakes mistakes_of_scene(const golden::Golden& golden, const std::vector<images::Image>& pictures,
                                double samples, const CompareCommand& options)
{
    if (options.scene.empty()) return {};
    const auto renders = std::make_shared<SceneRenders>(golden, samples, options);
    const RenderCommand& command = renders->command();
    if (command.integrator != "bdpt" || command.max_edges >= images::most_edges_of_strategies)
        throw std::invalid_argument("--scene needs a golden of bdpt, of paths of fewer than " +
                                    std::to_string(images::most_edges_of_strategies) + " edges");
    return {[=, &golden, &pictures] {
                return TransportMistakes(*renders, golden, pictures, samples).explain();
            },
            {[renders] { return half_pixel(*renders); },
             [renders, &golden] { return field_of_view(*renders, golden.mean); }}};
}

} // namespace cli
