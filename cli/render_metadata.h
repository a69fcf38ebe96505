#pragma once

// The metadata by which a render describes itself.

#include "cli/render_command.h"
#include "images/film.h"
#include "scenes/scene.h"

#include <string>

namespace cli {

/// All parameters that the picture depends on. They must be equal for one render to continue another.
/// Threads, tree builder and size of leaves change no bit and are not among them. Parameters that were
/// added later have no entry where they are at their defaults, so that files of those stay as they were.
images::Metadata describe(const RenderCommand& options, const scenes::Scene& scene);

/// `metadata` with the entries that `describe` leaves out at their defaults.
images::Metadata with_defaults(images::Metadata metadata);

using images::value_of;

} // namespace cli
