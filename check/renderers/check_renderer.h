#pragma once

// Checks somebody else's renderer, a program, against the goldens.

#include "check/mistakes/explanations.h"
#include "check/renderers/picture_folder.h"
#include "check/renderers/scene_check.h"
#include "check/renderers/suite.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace check {

struct RendererOptions {
    std::vector<std::string> command; // with the placeholders of words_for
    std::string ending = ".exr";      // of the pictures' names; or ".pfm"
    std::uint64_t samples = 64;       // per pixel and picture
    std::uint64_t series = 1;         // of seeds (seeds.h)
    double error = 0.005;             // that PASS takes to be seen
    std::uint64_t first_pictures = 16;
    std::uint64_t most_pictures = 256;                           // of a scene
    double budget = std::numeric_limits<double>::infinity();     // seconds, of all scenes together
    double time_limit = std::numeric_limits<double>::infinity(); // seconds, of one picture
    /// Asked often, also while a picture is rendered, and from several threads.
    std::function<bool()> stop = [] { return false; };
    /// Whether mistakes of light transport are looked for if scenes FAIL (common_mistake.h).
    bool mistakes = true;
    unsigned threads = 1; // for that
    ExplanationBudget mistakes_budget = {};
    /// Called before each picture: the scene, the pictures that it has, and those with which it will be
    /// judged.
    std::function<void(const SceneCheck&, std::uint64_t has, std::uint64_t wanted)> progress;
    /// Called while mistakes of light transport are rendered: how many batches of how many are done.
    std::function<void(const SceneCheck&, double done, double total)> mistakes_progress;
};

struct RendererCheck {
    std::vector<SceneCheck> scenes;
    std::string mistake;  // of light transport, that explains failing scenes: a sentence; empty if none
    bool stopped = false; // by `stop`
    bool time_up = false; // the budget was spent
    double seconds = 0.0; // of the whole check
};

/// Renders the scenes and judges them, in rounds: first each gets its first pictures, then those
/// without a verdict get more, as many again or as the judge estimates to be enough. A crash is a
/// verdict of that scene. Ends when all have a verdict or cannot get one, the budget is spent, or `stop`
/// returns true; then what is known is returned. Throws std::runtime_error if the program cannot be
/// started, std::invalid_argument for an unknown placeholder, and as SceneCheck's constructor.
RendererCheck check_renderer(const std::vector<SuiteScene>& scenes, const RendererOptions& options,
                             const PictureFolder& folder);

/// What the failing scenes have in common: the same diagnosis, a mistake of light transport, or a
/// feature (common_cause.h). Scenes without a verdict are left out. Empty if there is nothing.
std::vector<std::string> in_common(const RendererCheck& check);

/// The number of scenes with this verdict.
std::size_t count(const RendererCheck& check, SceneVerdict verdict);

} // namespace check
