#pragma once

// What `plumbline compare` is given, made comparable with a golden.

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

/// Chooses the method by what the files are: a scene is rendered in stages; a picture of ours with its
/// batches (`render --keep-batches`) and several pictures are compared by these; a single picture by the
/// noise that its number of samples lets expect. Throws images::ImageError, scenes::SceneError and
/// std::invalid_argument, which names the file, for what cannot be read or compared, pictures that are
/// not independent among it; Interrupted if a render was.
JudgedCandidate judge(const golden::Golden& golden, const std::vector<std::string>& files,
                      const CompareCommand& options);

} // namespace cli
