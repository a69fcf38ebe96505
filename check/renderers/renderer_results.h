#pragma once

// The results of a check for people, as text, and for machines, as JSON.

#include "check/renderers/check_renderer.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace check {

/// The ratio of a scene's whole picture to the golden's in the channel where it differs most; and the
/// smallest error that would have been seen, in the channel where that is largest.
struct WholePicture {
    std::size_t channel;     // 0 red, 1 green, 2 blue
    double ratio, low, high; // NaN where the golden is black
    double visible;          // relative; infinite: none
};
WholePicture whole_picture(const golden::Comparison& comparison);

/// "12 PASS, 1 FAIL, 1 NO PICTURE, 2 INCONCLUSIVE", without the kinds that do not occur.
std::string summary(const RendererCheck& check);

/// A table of all scenes, the reasons of those that do not pass, what failures have in common, and the
/// summary.
std::string results_table(const RendererCheck& check);

/// One object: verdict, command, what failures have in common, and an array of the scenes, each with
/// verdict, reason, diagnosis, ratios and visible errors by channel, pictures, seconds and features. NaN
/// and infinite numbers are null.
nlohmann::ordered_json results_json(const RendererCheck& check, const RendererOptions& options);

} // namespace check
