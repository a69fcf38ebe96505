#pragma once

#include "check/trees/build_attempt.h"
#include "check/trees/tree_files.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace check {

/// Somebody's program as a builder: runs `command` with {primitives} replaced by a `.npy` file of
/// primitives, and {tree} by an empty folder for the tree. The tree may also be the file {tree}.json.
/// Both are in `folder`, which must exist. Exit status 0 is success, every other one a rejection. A run
/// ends early when `stop` returns true.
///
/// Throws std::invalid_argument if the command lacks a placeholder or has an unknown one;
/// the attempts throw std::runtime_error if it cannot be started or the files cannot be written.
BuildAttempts command_builder(std::vector<std::string> command, PrimitiveFormat format,
                              std::filesystem::path folder, std::function<bool()> stop = {});

} // namespace check
