#pragma once

// What `plumbline compare` is given, made comparable with a golden.

#include "golden/comparison.h"
#include "golden/golden.h"
#include "images/exr.h"
#include "images/image.h"

#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace cli {

struct CandidateOptions {
    std::optional<double> samples;     // per pixel, of a single picture or of a scene's first stage
    std::string layer;                 // of .exr files; empty: their R, G and B
    std::string integrator;            // of a scene; empty: the golden's
    std::string device = "ref";        // that renders a scene
    std::optional<std::uint64_t> seed; // of a scene; none: another one every time
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    bool quiet = false;
};

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
                      const CandidateOptions& options);

/// Ctrl-C before there was anything to keep.
struct Interrupted {};

} // namespace cli
