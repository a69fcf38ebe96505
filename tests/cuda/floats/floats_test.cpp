// Many numbers at once (cuda/parallel/floats.h) are, lane by lane, what each would be alone. This file
// is compiled for the compiler's default instructions; tests/cuda/transport/stages_test.cpp compares the
// bits of the others.

#include "cuda/parallel/floats_records.h"

#include "cuda/stages/floats_rows.h"
#include "cuda/transport/floats_random.h"
#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <vector>

namespace {

using fast::Floats;
using fast::floats_at_once;
using fast::Mask;
using fast::Words;
using transport_test::any_word;

constexpr int lanes = static_cast<int>(floats_at_once);

template <class F>
struct PairOf {
    F number;
    fast::WordOf<F> word;
    fast::Vec3Of<F> vector;
};

/// Any words in all lanes: as floats also NaN, infinite and subnormal.
Words any_words()
{
    Words words(0u);
    for (int lane = 0; lane < lanes; ++lane) put_lane(words, lane, *any_word());
    return words;
}

Floats as_floats(const Words& words)
{
    return fast::hn::BitCast(fast::float_tag, words.v);
}

std::uint32_t bits(float x)
{
    return std::bit_cast<std::uint32_t>(x);
}

bool in_lane(const Mask& mask, int lane)
{
    return (bits_of(mask) >> lane & 1) != 0;
}

bool same(float a, float b)
{
    return bits(a) == bits(b) || (a != a && b != b);
}

RC_GTEST_PROP(Floats, AreComputedLaneByLane, ())
{
    const Floats a = as_floats(any_words());
    const Floats b = as_floats(any_words());
    for (int lane = 0; lane < lanes; ++lane) {
        const float x = lane_of(a, lane);
        const float y = lane_of(b, lane);
        RC_ASSERT(same(lane_of(a + b, lane), x + y));
        RC_ASSERT(same(lane_of(a - b, lane), x - y));
        RC_ASSERT(same(lane_of(a * b, lane), x * y));
        RC_ASSERT(same(lane_of(a / b, lane), x / y));
        RC_ASSERT(same(lane_of(-a, lane), -x));
        RC_ASSERT(same(lane_of(square_root(a), lane), fast::square_root(x)));
        RC_ASSERT(same(lane_of(magnitude_of(a), lane), fast::magnitude_of(x)));
        RC_ASSERT(same(lane_of(with_sign_of(a, b), lane), fast::with_sign_of(x, y)));
        RC_ASSERT(same(lane_of(fast::lesser(a, b), lane), fast::lesser(x, y)));
        RC_ASSERT(same(lane_of(fast::greater(a, b), lane), fast::greater(x, y)));
        RC_ASSERT(in_lane(a < b, lane) == (x < y));
        RC_ASSERT(in_lane(a <= b, lane) == (x <= y));
        RC_ASSERT(in_lane(a > b, lane) == (x > y));
        RC_ASSERT(in_lane(a >= b, lane) == (x >= y));
        RC_ASSERT(in_lane(a == b, lane) == (x == y));
        RC_ASSERT(in_lane(is_finite_number(a), lane) == fast::is_finite_number(x));
    }
}

RC_GTEST_PROP(Floats, DivideWholeNumbersWithRemainder, ())
{
    const Words x = *rc::gen::arbitrary<bool>() ? any_words() : any_words() & Words(0x3f'ffff);
    const std::uint32_t divisor = (*any_word() >> *rc::gen::inRange(0, 31)) | 1;
    Words remainder(0u);
    const Words quotient = divided(x, divisor, remainder);
    for (int lane = 0; lane < lanes; ++lane) {
        RC_ASSERT(lane_of(quotient, lane) == lane_of(x, lane) / divisor);
        RC_ASSERT(lane_of(remainder, lane) == lane_of(x, lane) % divisor);
    }
}

RC_GTEST_PROP(Floats, AreReadByIndexAndSelected, ())
{
    std::vector<PairOf<float>> table;
    for (int i = 0; i < 40; ++i)
        table.push_back({static_cast<float>(i), *any_word(), fast::Vec3(i + 1, i + 2, i + 3)});
    Words index(0u);
    for (int lane = 0; lane < lanes; ++lane) put_lane(index, lane, *any_word() % 40);
    const PairOf<Floats> read = at(std::span<const PairOf<float>>(table), index);
    const PairOf<Floats> zeros{};
    const Mask mask = fast::mask_of_bits(*any_word() & ((1u << lanes) - 1));
    const PairOf<Floats> chosen = select(mask, read, zeros);
    for (int lane = 0; lane < lanes; ++lane) {
        const PairOf<float>& expected = table[lane_of(index, lane)];
        const PairOf<float> one = lane_of(read, lane);
        RC_ASSERT(one.number == expected.number);
        RC_ASSERT(one.word == expected.word);
        RC_ASSERT(one.vector == expected.vector);
        RC_ASSERT(lane_of(chosen, lane).number == (in_lane(mask, lane) ? expected.number : 0.0f));
    }
}

RC_GTEST_PROP(Floats, HaveTheRandomNumbersOfTheirSamples, (std::uint64_t seed))
{
    const Words pixel = any_words();
    const Words sample = any_words();
    const std::uint32_t vertex = *any_word() >> 8;
    const auto all =
        uniforms(fast::SampleIdOf<Floats>{seed, pixel, sample}, fast::Event::next_event, vertex);
    for (int lane = 0; lane < lanes; ++lane) {
        const fast::Uniforms one =
            uniforms(fast::SampleId{seed, lane_of(pixel, lane), lane_of(sample, lane)},
                     fast::Event::next_event, vertex);
        for (int i = 0; i < 4; ++i) RC_ASSERT(lane_of(all[i], lane) == one[i]);
    }
}

RC_GTEST_PROP(Queue, KeepsWhatIsPushedInOrder, ())
{
    constexpr std::uint32_t capacity = 100;
    std::vector<std::uint32_t> words(fast::Rows<PairOf>::words_for(capacity));
    std::uint32_t count = 0;
    const fast::Queue<PairOf> queue{{words, capacity}, &count};
    std::vector<std::uint32_t> expected;
    while (expected.size() + floats_at_once <= capacity) {
        const PairOf<Floats> value{Floats(1.0f), any_words(), fast::Vec3Of<Floats>(2.0f)};
        const Mask mask = fast::mask_of_bits(*any_word() & ((1u << lanes) - 1));
        push(queue, mask, value);
        for (int lane = 0; lane < lanes; ++lane)
            if (in_lane(mask, lane)) expected.push_back(lane_of(value.word, lane));
        if (*rc::gen::inRange(0, 10) == 0) break;
    }
    RC_ASSERT(count == expected.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        RC_ASSERT(load(queue.rows, i).word == expected[i]);
        RC_ASSERT(load(queue.rows, i).vector == fast::Vec3(2.0f));
    }
    if (count == 0) return;
    const std::uint32_t first = *any_word() % count;
    const std::uint32_t part = std::min(floats_at_once, count - first);
    const PairOf<Floats> loaded = load(queue.rows, fast::FloatsAt{first, part});
    for (std::uint32_t i = 0; i < part; ++i)
        RC_ASSERT(lane_of(loaded.word, static_cast<int>(i)) == expected[first + i]);
}

} // namespace
