#include "cli/golden_mismatch.h"

#include "cli/render_metadata.h"
#include "cli/scene_input.h"
#include "images/image_error.h"
#include "images/whole_number.h"

#include <cstdint>
#include <string>
#include <utility>

namespace cli {

namespace {

std::string say_size(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

/// The list of differences, as text.
class Differences {
public:
    /// `option`: the command-line option of the value `asked`, if there is one.
    void compare(const std::string& name, const std::string& there, const std::string& asked,
                 const std::string& option = "")
    {
        if (there == asked) return;
        add("its " + name + " is " + (there.empty() ? "not said" : there) + ", not " +
            (asked.empty() ? "left unsaid" : asked) + (option.empty() ? "" : " (" + option + ")"));
    }
    void add(const std::string& what) { text_ += (text_.empty() ? "" : "; ") + what; }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// A finished golden must have exactly the samples of the options, an unfinished one at most as many.
void compare_samples(const GoldenCommand& options, const FoundGolden& found, Differences& differences)
{
    const std::string there = value_of(found.metadata, "samples");
    const std::string asked = std::to_string(options.samples);
    const auto number = images::whole_number(there);
    if (found.finished || !number)
        differences.compare("number of samples", there, asked, "-s");
    else if (*number > options.samples)
        differences.add("it has " + there + " samples already, more than " + asked + " (-s)");
}

} // namespace

void expect_made_so(const GoldenCommand& options, Ask ask, const FoundGolden& found,
                    const images::Metadata& render_says)
{
    const bool all = ask == Ask::all_options;
    const Size size = parse_size(options.size);
    const GoldenCommand::Given& given = options.given;
    const images::Metadata& there = found.metadata;
    Differences differences;
    if (all || given.size)
        differences.compare("size", say_size(found.mean.width, found.mean.height),
                            say_size(size.width, size.height), "--size");
    if (all || given.batch_size)
        differences.compare("batch_size", value_of(there, "batch_size"),
                            std::to_string(options.batch_size), "--batch");
    if (all || given.pilot_batches)
        differences.compare("number of pilot batches", value_of(there, "golden.pilot_batches"),
                            std::to_string(options.pilot_batches), "--pilot");
    if (all || given.max_edges)
        differences.compare("max_edges", value_of(there, "max_edges"), std::to_string(options.max_edges),
                            "--max-edges");
    if (all || given.samples) compare_samples(options, found, differences);
    for (const auto& [key, value] : render_says)
        // Goldens of earlier versions stay valid.
        if (key != "version" && key != "batch_size" && key != "max_edges")
            differences.compare(key, value_of(there, key), value);
    if (!differences.text().empty())
        throw images::ImageError(found.path,
                                 "is another golden: " + differences.text() +
                                     ". Name another --folder, or remove the file to make it anew");
}

} // namespace cli
