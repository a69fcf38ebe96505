#include "explain/page.h"

#include "explain/drawing.h"
#include "explain/json.h"
#include "explain/names.h"
#include "explain/page_parts.h"   // made from the files in page/
#include "explain/source_lines.h" // made from the sources of ref/
#include "images/page_scripts.h"
#include "images/page_template.h"

#include <nlohmann/json.hpp>

namespace explain {

namespace {

nlohmann::ordered_json lines()
{
    namespace at = source_lines;
    return {{"emission_hit", at::emission_hit},
            {"next_event", at::next_event},
            {"light_image", at::light_image},
            {"inner_connection", at::inner_connection},
            {"path_emission_hit", at::path_emission_hit},
            {"path_next_event", at::path_next_event},
            {"weight", at::weight},
            {"quotient", at::quotient},
            {"path_weight_hit", at::path_weight_hit},
            {"path_weight_event", at::path_weight_event},
            {"vertex_densities", at::vertex_densities},
            {"walk_alpha", at::walk_alpha},
            {"path_alpha", at::path_alpha},
            {"uniforms", at::uniforms}};
}

} // namespace

std::string page(const ref::World& world, const Sample& sample)
{
    const std::string title = "One sample of " + images::html_text(world.scene.name);
    const nlohmann::ordered_json data = {{"sample", nlohmann::ordered_json::parse(json(world, sample))},
                                         {"eye_end", sentence(sample.eye.end)},
                                         {"light_end", sentence(sample.light.end)},
                                         {"lines", lines()}};
    const std::string text = images::script_data(data.dump(-1, ' ', true));
    const std::string figure = drawing(world, sample, Paths::hidden);
    const std::string scripts = images::page_scripts();
    return images::fill(page_parts::html,
                        std::array<images::Mark, 6>{{{"@TITLE@", title},
                                                     {"@STYLE@", page_parts::style},
                                                     {"@DRAWING@", figure},
                                                     {"@DATA@", text},
                                                     {"@SCRIPTS@", scripts},
                                                     {"@SCRIPT@", page_parts::script}}});
}

} // namespace explain
