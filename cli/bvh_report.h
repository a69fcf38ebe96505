#pragma once

// The measurements of `plumbline bvh` as a table for people and as one JSON object for machines.

#include "cli/bvh_measure.h"
#include "cli/bvh_stages.h"

#include <cstdint>
#include <iosfwd>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

/// The builders of the reference, measured on one scene.
struct MeasuredBuilders {
    std::string scene;
    std::uint32_t primitives = 0;
    std::vector<MeasuredBuilder> builders;
};

/// Tables. They leave `out` in fixed notation.
void print_builders(std::ostream& out, const MeasuredBuilders& measured);
void print_stages(std::ostream& out, const MeasuredStages& measured);

/// One JSON object in one line, without a line break at its end. A standard error that there is not (no
/// rays were traced) and numbers that are not finite are null; a bandwidth or a tree that was not
/// measured has no entry.
std::string builders_json(const MeasuredBuilders& measured);
std::string stages_json(const MeasuredStages& measured);

} // namespace cli
