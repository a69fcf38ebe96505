#include "cuda/trees/check_input.h"

#include <stdexcept>
#include <string>

namespace fast {

void throw_if_rejected(std::uint32_t first_rejected, std::span<const Aabb> boxes)
{
    if (first_rejected == no_primitive) return;
    throw std::invalid_argument("primitive " + std::to_string(first_rejected) +
                                (is_empty(boxes[first_rejected])
                                     ? ": its box is empty"
                                     : ": a coordinate of its box is NaN or infinite"));
}

} // namespace fast
