#pragma once

// A fold over numbered batches whose shape depends on their numbers alone, so that ranges of batches can
// be folded on different machines and joined later, with the bits of one machine.
//
// A block holds 2^k batches from a multiple of 2^k on. It is made from its two halves, in one way; a
// block of one batch is that batch. Any range of batches is a row of largest blocks in one way, at most
// two of each size: batches 3 to 10 are the blocks {3} {4 5 6 7} {8 9} {10}. These are kept. Where
// two halves of a block meet they become the block, as digits do that carry in binary addition: after n
// batches from 0 on there are as many blocks as n has binary ones. It is also the more exact way to add:
// a value takes part in log2(n) additions and not in n [Higham 1993, "The accuracy of floating point
// summation"].

#include "images/batch_range.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace images {

/// The fold over a range of batches. Value::join(other, own, others) makes a value of `own` batches that
/// of these and of the `others` batches that follow them.
template <class Value>
class BatchFold {
public:
    /// No batch yet; the first will have the number `first`.
    explicit BatchFold(std::uint64_t first = 0) : range_{first, first} {}

    /// The state of an earlier fold: its range, and the values of its largest blocks. Throws
    /// std::invalid_argument for another number of values.
    BatchFold(const BatchRange& range, std::vector<Value> blocks)
        : range_(range), blocks_(std::move(blocks))
    {
        if (blocks_.size() != largest_blocks(range).size())
            throw std::invalid_argument("batches " + describe(range) + " are not " +
                                        std::to_string(blocks_.size()) + " blocks");
    }

    /// Adds the batch that follows.
    void add(Value batch) { add_block(std::move(batch), 1); }

    /// Adds the batches of `next`, which follow. Throws std::invalid_argument if they do not.
    void append(BatchFold next)
    {
        if (next.range_.first != range_.end)
            throw std::invalid_argument("batches " + describe(next.range_) + " do not follow batches " +
                                        describe(range_));
        const std::vector<BatchRange> ranges = largest_blocks(next.range_);
        for (std::size_t i = 0; i < ranges.size(); ++i)
            add_block(std::move(next.blocks_[i]), ranges[i].size());
    }

    [[nodiscard]] const BatchRange& range() const { return range_; }
    /// The values of largest_blocks(range()).
    [[nodiscard]] const std::vector<Value>& blocks() const { return blocks_; }

    /// The value of all batches together; `none` if there is none. The last blocks, mostly the smallest,
    /// are joined first.
    [[nodiscard]] Value total(Value none) const
    {
        if (blocks_.empty()) return none;
        const std::vector<BatchRange> ranges = largest_blocks(range_);
        Value last = blocks_.back();
        std::uint64_t count = ranges.back().size();
        for (std::size_t i = blocks_.size() - 1; i-- > 0;) {
            Value joined = blocks_[i];
            joined.join(last, ranges[i].size(), count);
            last = std::move(joined);
            count += ranges[i].size();
        }
        return last;
    }

    friend bool operator==(const BatchFold&, const BatchFold&) = default;

private:
    /// `size`: of an aligned block that begins at the end of the range.
    void add_block(Value block, std::uint64_t size)
    {
        blocks_.push_back(std::move(block));
        range_.end += size;
        // The end of the range is a multiple of twice the size: the block is a second half.
        while (range_.end % (2 * size) == 0 && range_.size() >= 2 * size) {
            Value second = std::move(blocks_.back());
            blocks_.pop_back();
            blocks_.back().join(second, size, size);
            size *= 2;
        }
    }

    BatchRange range_;
    std::vector<Value> blocks_;
};

} // namespace images
