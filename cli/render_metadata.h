#pragma once

// The metadata by which a render describes itself.

#include "cli/render_command.h"
#include "images/film.h"
#include "scenes/scene.h"

#include <string>

namespace cli {

/// Everything that shapes the picture, and so must be the same for one render to go on from another: not
/// the threads and not the builder of the tree, which change no bit.
images::Metadata describe(const RenderCommand& options, const scenes::Scene& scene);

/// What the metadata say of `key`; the empty string if they say nothing.
std::string value_of(const images::Metadata& metadata, const std::string& key);

} // namespace cli
