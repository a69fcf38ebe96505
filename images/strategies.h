#pragma once

// One picture per strategy (s, t), weighted or unweighted.

#include "images/batch_fold.h"
#include "images/image.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace images {

/// Pictures of the same size by strategy (s, t), s >= 0, t >= 1.
using Strategies = std::map<std::pair<int, int>, Image>;

/// The name of a strategy's layer in a picture file: "s2t3".
inline std::string layer_name(int s, int t)
{
    return "s" + std::to_string(s) + "t" + std::to_string(t);
}

/// The pictures by these names.
std::map<std::string, Image> layers_of(const Strategies& pictures);

/// "s2t3" as (2, 3); none for another text.
std::optional<std::pair<int, int>> parse_layer_name(std::string_view text);

/// Sums over a block of batches.
struct StrategyBlock {
    Strategies sums;

    void join(const StrategyBlock& other, std::uint64_t own, std::uint64_t others);
    friend bool operator==(const StrategyBlock&, const StrategyBlock&) = default;
};

/// Sums of the strategies of batches, folded as a film is (batch_fold.h).
class StrategySums {
public:
    explicit StrategySums(std::uint64_t first = 0) : fold_(first) {}
    /// The state of earlier sums: of the largest blocks of the range. Throws std::invalid_argument if
    /// their number disagrees.
    StrategySums(const BatchRange& range, std::vector<StrategyBlock> blocks)
        : fold_(range, std::move(blocks))
    {}

    /// Adds the sums over the samples of the batch that follows.
    void add(const Strategies& batch) { fold_.add({batch}); }
    /// Adds those of other batches, which follow. Throws std::invalid_argument if they do not.
    void append(StrategySums next) { fold_.append(std::move(next.fold_)); }

    [[nodiscard]] const BatchRange& range() const { return fold_.range(); }
    /// Of the largest blocks of the range, ascending.
    [[nodiscard]] const std::vector<StrategyBlock>& blocks() const { return fold_.blocks(); }
    /// The mean pictures so far, of the strategies with contributions. `batch_size`: samples in a batch.
    [[nodiscard]] Strategies means(std::uint32_t batch_size) const;
    friend bool operator==(const StrategySums&, const StrategySums&) = default;

private:
    BatchFold<StrategyBlock> fold_;
};

} // namespace images
