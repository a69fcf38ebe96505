#include "extremes/page.h"

#include "extremes/page_parts.h" // made from the files in page/
#include "images/page_scripts.h"
#include "images/page_template.h"

#include <array>

namespace extremes {

std::string page(const nlohmann::ordered_json& results)
{
    const std::string data = images::script_data(
        results.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
    const std::string scripts = images::page_scripts();
    return images::fill(page_parts::html,
                        std::array<images::Mark, 7>{{{"@STYLE@", page_parts::style},
                                                     {"@SCRIPTS@", scripts},
                                                     {"@DATA@", data},
                                                     {"@BASICS@", page_parts::basics},
                                                     {"@LIMITS@", page_parts::limits},
                                                     {"@PLOTS@", page_parts::plots},
                                                     {"@NUMBERS@", page_parts::numbers}}});
}

} // namespace extremes
