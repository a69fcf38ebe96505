#include "cli/render_report.h"

#include "cli/resources.h"
#include "scenes/is_emitter.h"
#include "scenes/requirements.h"

#include <glm/exponential.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace cli {

namespace {

using Json = nlohmann::ordered_json;

Json channels(const images::Rgb& value)
{
    return {value.x, value.y, value.z};
}

template <class Enumeration>
Json names(const std::set<Enumeration>& required)
{
    Json list = Json::array();
    for (const Enumeration one : required) list.push_back(scenes::name_of(one));
    return list;
}

Json requirements_json(const scenes::Scene& scene)
{
    const scenes::Requirements required = scenes::requirements(scene);
    return {{"shapes", names(required.shapes)},
            {"bsdfs", names(required.bsdfs)},
            {"emitters", names(required.emitters)},
            {"strategies", names(required.strategies)},
            {"fov_axes", names(required.fov_axes)}};
}

/// The features of the kernel besides triangles and Lambertian surfaces.
Json kernel_json(const std::optional<fast::Needs>& kernel)
{
    if (!kernel) return nullptr;
    return {{"spheres", kernel->spheres},
            {"specular", kernel->specular},
            {"other_lights", kernel->other_lights},
            {"coincident", kernel->coincident}};
}

} // namespace

images::Rgb mean_of(const images::Image& image)
{
    images::Rgb sum(0.0);
    for (const images::Rgb& pixel : image.pixels) sum += pixel;
    return sum / static_cast<double>(image.pixels.size());
}

void PictureMean::add_batch(const images::Image& batch)
{
    images::Image pixel(1, 1);
    pixel.pixels[0] = mean_of(batch);
    film_.add_batch(pixel);
}

std::optional<images::Rgb> PictureMean::standard_error(std::uint64_t batches) const
{
    if (film_.batches() < 2) return std::nullopt;
    const images::Rgb variance =
        film_.moments().squares.pixels[0] / static_cast<double>(film_.batches() - 1);
    return glm::sqrt(variance / static_cast<double>(batches));
}

bool is_unexpectedly_black(const scenes::Scene& scene, const images::Image& picture)
{
    const auto dark = [](const images::Rgb& pixel) {
        return glm::vec3(pixel) == glm::vec3(0.0f); // as files hold it
    };
    return scenes::has_emitter(scene) && std::ranges::all_of(picture.pixels, dark);
}

std::vector<std::string> warnings(const RenderRun& run)
{
    std::vector<std::string> lines;
    if (run.dropped.count > 0) lines.push_back(describe(run.dropped, run.film.width()));
    if (run.film.batches() > 0 && is_unexpectedly_black(run.scene, run.film.mean()))
        lines.emplace_back(
            "the picture is exactly black although the scene has emitters: their light is "
            "too weak for 32-bit floats, does not reach the camera within --max-edges, or "
            "is found by no strategy of this integrator");
    return lines;
}

std::string render_json(const RenderCommand& options, const RenderRun& run)
{
    const std::uint64_t held = run.film.batches() * options.batch_size;
    const images::Image mean = run.film.mean();
    const auto error = run.mean.standard_error(run.film.batches());
    const auto rate = [&](double time) { return time > 0.0 ? run.samples / time : 0.0; };
    const Json json = {{"scene", run.scene.name},
                       {"device", options.device},
                       {"builder", run.builder},
                       {"integrator", options.integrator},
                       {"width", run.film.width()},
                       {"height", run.film.height()},
                       {"samples_per_pixel", held},
                       {"batch_size", options.batch_size},
                       {"batches", describe(run.film.range())},
                       {"complete", run.film.range().end == range_of(options).end},
                       {"samples", run.samples},
                       {"seconds", run.seconds},
                       {"cpu_seconds", run.cpu_seconds},
                       {"build_seconds", run.build_seconds},
                       {"build_cpu_seconds", run.build_cpu_seconds},
                       {"samples_per_second", rate(run.seconds)},
                       {"samples_per_cpu_second", rate(run.cpu_seconds)},
                       {"threads", options.threads},
                       {"peak_rss_bytes", peak_rss_bytes()},
                       {"mean_rgb", channels(mean_of(mean))},
                       {"mean_rgb_standard_error", error ? channels(*error) : Json(nullptr)},
                       {"dropped", run.dropped.count},
                       {"black_despite_emitters", is_unexpectedly_black(run.scene, mean)},
                       {"requirements", requirements_json(run.scene)},
                       {"kernel", kernel_json(run.kernel)},
                       {"outputs", options.outputs}};
    return json.dump();
}

} // namespace cli
