// The limits in docs/results/extremes.md are those of the program.

#include "extremes/results.h"
#include "images/atomic_file.h"

#include <gtest/gtest.h>

namespace extremes {

TEST(ExtremesDocumentation, HasTheLimitsOfTheProgram)
{
    std::vector<WalkedAxis> walked;
    for (const Axis& axis : all_axes()) {
        walked.push_back({axis, {}});
        for (const Method& method : axis.methods) walked.back().methods.push_back({method, {}});
    }
    const Json json = results({}, walked);
    const std::string text =
        images::read_file(std::string(PLUMBLINE_SOURCE_DIR) + "/docs/results/extremes.md");
    EXPECT_NE(text.find(limits_in_markdown(json)), std::string::npos)
        << "the table of limits is not this one (./run figures extremes_long writes it):\n"
        << limits_in_markdown(json);
    for (const Json& axis : json.at("axes")) {
        const std::string name = axis.at("name");
        for (const std::string& part : {"(`" + name + "`)", "images/extremes_" + name + ".png",
                                        axis.at("about").get<std::string>()})
            EXPECT_NE(text.find(part), std::string::npos) << part;
        for (const Json& limit : axis.at("limits"))
            EXPECT_NE(text.find(limit.at("because").get<std::string>()), std::string::npos)
                << name << ": " << limit.at("because");
    }
}

} // namespace extremes
