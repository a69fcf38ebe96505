#include "trade/page.h"
#include "images/page_scripts.h"
#include "images/page_template.h"
#include "trade/page_parts.h" // made from the files in page/

#include <array>

namespace trade {

namespace {

/// The name of the scene, or "".
std::string scene_name(const nlohmann::ordered_json& results)
{
    const auto scene = results.find("scene");
    if (scene == results.end() || !scene->is_object()) return "";
    const auto name = scene->find("name");
    return name != scene->end() && name->is_string() ? name->get<std::string>() : "";
}

} // namespace

std::string page(const nlohmann::ordered_json& results)
{
    const std::string name = scene_name(results);
    const std::string title =
        "Speed against accuracy" + (name.empty() ? "" : ": " + images::html_text(name));
    const std::string scripts = images::page_scripts();
    const std::string data = images::script_data(
        results.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
    return images::fill(page_parts::html,
                        std::array<images::Mark, 9>{{{"@TITLE@", title},
                                                     {"@STYLE@", page_parts::style},
                                                     {"@SCRIPTS@", scripts},
                                                     {"@DATA@", data},
                                                     {"@BASICS@", page_parts::basics},
                                                     {"@LABELS@", page_parts::labels},
                                                     {"@MAIN_PLOT@", page_parts::main_plot},
                                                     {"@KNOB_PLOTS@", page_parts::knob_plots},
                                                     {"@TABLES@", page_parts::tables}}});
}

} // namespace trade
