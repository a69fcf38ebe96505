#pragma once

// One picture per strategy (s, t), weighted or unweighted.

#include "images/image.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace images {

/// Pictures of the same size by strategy (s, t), s >= 0, t >= 1.
using Strategies = std::map<std::pair<int, int>, Image>;

/// The name of a strategy's layer in a picture file: "s2t3".
inline std::string layer_name(int s, int t)
{
    return "s" + std::to_string(s) + "t" + std::to_string(t);
}

/// Sums of the strategies of batches.
class StrategySums {
public:
    /// Adds the sums over the `samples` samples per pixel of a batch.
    void add(const Strategies& batch, std::uint32_t samples);
    /// The mean pictures so far, of the strategies with contributions.
    [[nodiscard]] Strategies means() const;

private:
    Strategies sums_;
    std::uint64_t samples_ = 0;
};

} // namespace images
