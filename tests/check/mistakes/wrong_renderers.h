#pragma once

// Renderers with one mistake each, made in the code that samples: what a strategy adds, how a walk goes
// on. They share no code with check/mistakes, which derives the pictures from the paths.

#include "images/image.h"
#include "ref/transport/world.h"

#include <string>
#include <vector>

namespace mistakes_test {

/// A picture by a wrong renderer, and a part of its diagnosis.
struct WrongPicture {
    std::string is;
    images::Image image;
};

/// Pictures of bidirectional path tracing with mistakes, all of the same samples. options.max_edges is
/// one more than a right picture has. The first picture of this and the other functions is right, and
/// its `is` is empty.
std::vector<WrongPicture> wrong_bidirectional(const ref::World& world, const ref::PathOptions& options,
                                              std::uint32_t samples);

/// Pictures of path tracing with mistakes.
std::vector<WrongPicture> wrong_path_tracing(const ref::World& world, const ref::PathOptions& options,
                                             std::uint32_t samples);

/// Pictures by bidirectional path tracing whose walks treat refraction wrongly.
std::vector<WrongPicture> wrong_refraction(const ref::World& world, const ref::PathOptions& options,
                                           std::uint32_t samples);

} // namespace mistakes_test
