#pragma once

// Compares the files of `plumbline compare` with a golden.

#include "cli/compare_command.h"
#include "golden/comparison.h"
#include "golden/golden.h"
#include "images/exr.h"
#include "images/image.h"

#include <string>
#include <vector>

namespace cli {

struct JudgedCandidate {
    golden::Comparison comparison;
    images::Image mean;
    images::Metadata metadata;
    images::Layers strategies;
};

/// Chooses the method by the kind of the files. A scene is rendered in stages. A picture with its
/// batches
/// (`render --keep-batches`) is compared by its batches, several pictures as independent batches, a
/// single picture by the noise that its number of samples makes expect. Throws images::ImageError,
/// scenes::SceneError or std::invalid_argument, with the name of the file, if a file cannot be read or
/// compared or pictures are not independent; Interrupted if a render was interrupted.
JudgedCandidate judge(const golden::Golden& golden, const std::vector<std::string>& files,
                      const CompareCommand& options);

} // namespace cli
