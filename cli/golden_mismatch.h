#pragma once

// Was an existing golden made with the options that are given now?

#include "cli/golden_command.h"
#include "images/film.h"

#include <filesystem>

namespace cli {

/// A golden in a file, finished or not.
struct FoundGolden {
    const std::filesystem::path& path;
    const images::Image& mean;
    const images::Metadata& metadata;
    bool finished;
};
enum class Ask { all_options, given_options };

/// Throws images::ImageError that names each difference, with both values, if the golden was made with
/// other options: all of them, or only those that were given. `render_says`: the metadata of the render
/// of the scene; other entries are not compared.
void expect_made_so(const GoldenCommand& options, Ask ask, const FoundGolden& found,
                    const images::Metadata& render_says);

} // namespace cli
