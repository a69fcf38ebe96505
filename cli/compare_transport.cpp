#include "cli/compare_transport.h"

#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "golden/transport_faults.h"

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
        // For each render some 20 seconds of one processor core.
        constexpr double most_samples = 1 << 21;
        const double wanted = samples > 0.0 ? samples : static_cast<double>(command_.samples);
        const double per_pixel =
            std::min(wanted, most_samples / static_cast<double>(golden.mean.pixels.size()));
        command_.samples = whole_batches(per_pixel);
        command_.threads = options.threads;
        command_.quiet = options.quiet;
        ++command_.seed; // other noise than the golden's
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

    /// The light of paths of up to one edge more than the golden's have; made once.
    const golden::LightByEdges& light()
    {
        if (!light_.empty()) return light_;
        RenderCommand command = command_;
        ++command.max_edges;
        command.strategies = "weighted"; // not a file: it asks for pictures of strategies
        images::StrategySums sums;
        render(command, scene_,
               [&](const images::Batch& batch) { sums.add(batch.strategies, command.batch_size); });
        const Size size = parse_size(command.size);
        light_.assign(static_cast<std::size_t>(command.max_edges),
                      images::Image(size.width, size.height));
        for (const auto& [strategy, image] : sums.means()) {
            const auto edges = static_cast<std::size_t>(strategy.first + strategy.second - 1);
            images::Image& sum = light_.at(edges - 1);
            for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
        }
        return light_;
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
        Progress progress(scene.name + ", to find the mistake", 0.0, static_cast<double>(batches),
                          command.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const auto renderer = renderer_for(command, scene);
        if (!render_batches(*renderer, 0, batches, monitor, add)) throw Interrupted();
    }

    RenderCommand command_;
    scenes::Scene scene_;
    golden::LightByEdges light_;
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

} // namespace

std::vector<golden::MakeFaults> faults_of_scene(const golden::Golden& golden, double samples,
                                                const CompareCommand& options)
{
    if (options.scene.empty()) return {};
    const auto renders = std::make_shared<SceneRenders>(golden, samples, options);
    const RenderCommand& command = renders->command();
    if (command.integrator != "bdpt" || command.max_edges >= images::most_edges_of_strategies)
        throw std::invalid_argument("--scene needs a golden of bdpt, of paths of fewer than " +
                                    std::to_string(images::most_edges_of_strategies) + " edges");
    return {
        [renders] { return golden::transport_faults(renders->light(), renders->command().max_edges); },
        [renders] { return half_pixel(*renders); },
        [renders, &golden] { return field_of_view(*renders, golden.mean); }};
}

} // namespace cli
