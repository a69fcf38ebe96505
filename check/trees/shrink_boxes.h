#pragma once

#include "ref/trees/aabb.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace check {

struct ShrunkBoxes {
    std::vector<ref::Aabb> boxes;
    std::size_t tries = 0; // how often `fails` was called
};

/// A smallest set of boxes made from `boxes` for which `fails` is true still: no part of it can be left
/// out, and no coordinate replaced by a simpler number. `boxes` must fail. Calls `fails` until it has
/// found one or until `give_up` is true; then it returns the smallest so far. All coordinates stay
/// floats if they were.
ShrunkBoxes shrink_boxes(std::vector<ref::Aabb> boxes,
                         const std::function<bool(const std::vector<ref::Aabb>&)>& fails,
                         const std::function<bool()>& give_up);

} // namespace check
