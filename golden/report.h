#pragma once

// A comparison as numbers for machines and as a page for people.

#include "golden/comparison.h"
#include "golden/golden.h"
#include "images/exr.h"
#include "images/image.h"

#include <filesystem>
#include <string>

namespace golden {

/// A comparison and its pictures.
struct Report {
    std::string title;
    const Comparison& comparison;
    const Golden& golden;
    const images::Image& candidate; // the mean of all its batches
    images::Metadata candidate_metadata;
    /// Of the candidate, by the names of images::layer_name ("s2t3"); may be empty.
    images::Layers strategies = {};
};

/// One JSON object: verdict, reason, p, per channel ratio, interval, smallest detectable error and what
/// limit by the golden's noise, odd pixels, all findings, the tiles' z, stages, and the metadata of both
/// pictures. NaN and infinite numbers are null.
std::string report_json(const Report& report);

/// A self-contained HTML page: the numbers of report_json, both pictures under one slider with zoom and
/// exposure, z per tile, the histogram of p-values, the HDR-FLIP map, and the strategies if there are
/// any. It loads no other files.
std::string report_page(const Report& report);

/// Writes report_page. Throws ImageError.
void write_report(const std::filesystem::path& path, const Report& report);

} // namespace golden
