#include "cli/render_resume.h"

#include "cli/render_metadata.h"
#include "cli/scene_input.h"
#include "images/exr.h"
#include "images/file_ending.h"
#include "images/whole_number.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace cli {

images::Film starting_film(const RenderCommand& options, const images::Metadata& description,
                           images::Dropped& dropped)
{
    const Size size = parse_size(options.size);
    const images::BatchRange range = range_of(options);
    if (!options.resume) return {size.width, size.height, range.first};
    const auto exr = std::ranges::find_if(
        options.outputs, [](const std::string& path) { return images::has_ending(path, ".exr"); });
    if (exr == options.outputs.end())
        throw std::invalid_argument(
            "--resume needs an .exr among the outputs: only it holds all digits");
    if (!std::filesystem::exists(*exr)) return {size.width, size.height, range.first};

    images::ExrPicture picture = images::read_exr(*exr);
    if (!picture.film) throw std::invalid_argument(*exr + ": " + picture.no_state);
    const images::Metadata held = with_defaults(picture.metadata);
    for (const auto& [name, value] : with_defaults(description)) {
        const std::string found = value_of(held, name);
        if (found == value) continue;
        const bool batch = name == "batch_size"; // may be a default
        throw std::invalid_argument(*exr + ": cannot resume: its " + name + " is '" + found +
                                    "', not '" + value + "'" +
                                    (batch ? ": --batch " + found + " goes on with it" : ""));
    }
    const images::Film& film = *picture.film;
    if (film.width() != size.width || film.height() != size.height)
        throw std::invalid_argument(*exr + ": cannot resume: it has " + std::to_string(film.width()) +
                                    "x" + std::to_string(film.height()) + " pixels, not " +
                                    options.size);
    if (film.range().first != range.first)
        throw std::invalid_argument(*exr + ": cannot resume: it begins with batch " +
                                    std::to_string(film.range().first) + ", not " +
                                    std::to_string(range.first));
    if (film.range().end > range.end)
        throw std::invalid_argument(*exr + ": holds " +
                                    (options.batches.empty()
                                         ? std::to_string(film.batches() * options.batch_size) +
                                               " samples per pixel already, more than -s " +
                                               std::to_string(options.samples)
                                         : "batches " + describe(film.range()) +
                                               " already, more than --batches " + options.batches));
    const std::string lacking = value_of(picture.metadata, "dropped");
    if (!lacking.empty()) {
        const auto count = images::whole_number(lacking);
        if (!count)
            throw std::invalid_argument(*exr + ": its dropped is '" + lacking + "', not a number");
        dropped.count = *count;
    }
    return std::move(*picture.film);
}

} // namespace cli
