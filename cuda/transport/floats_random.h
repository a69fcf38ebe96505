#pragma once

// Random numbers of many samples at once: Philox4x32-10 as in random.h, word by word.

#include "cuda/parallel/floats_records.h"
#include "cuda/transport/random.h"

namespace fast {

namespace detail {

/// The product of every lane and `factor`, 64 bits wide.
inline void multiply_wide(const Words& a, std::uint32_t factor, Words& high, Words& low)
{
    constexpr hn::RepartitionToWide<decltype(word_tag)> wide_tag;
    const auto b = hn::Set(word_tag, factor);
    const auto even = hn::MulEven(a.v, b);
    const auto shifted = hn::ShiftRight<32>(hn::BitCast(wide_tag, a.v));
    const auto odd = hn::MulEven(hn::BitCast(word_tag, shifted), b);
    high = hn::OddEven(hn::BitCast(word_tag, odd), hn::BitCast(word_tag, hn::ShiftRight<32>(even)));
    low = hn::OddEven(hn::BitCast(word_tag, hn::ShiftLeft<32>(odd)), hn::BitCast(word_tag, even));
}

} // namespace detail

/// The random numbers of `event` at vertex `j` of all these samples. The constants are those of
/// [Salmon et al. 2011, sec. 3 and table 2].
inline UniformsOf<Floats> uniforms(const SampleIdOf<Floats>& id, Event event, std::uint32_t j = 0)
{
    Words counter[4] = {id.pixel, id.sample, Words(static_cast<std::uint32_t>(event) << 24 | j),
                        Words(0u)};
    auto key0 = static_cast<std::uint32_t>(id.seed);
    auto key1 = static_cast<std::uint32_t>(id.seed >> 32);
    for (int round = 0; round < 10; ++round) {
        Words high0;
        Words low0;
        Words high1;
        Words low1;
        detail::multiply_wide(counter[0], 0xd251'1f53, high0, low0);
        detail::multiply_wide(counter[2], 0xcd9e'8d57, high1, low1);
        counter[0] = high1 ^ counter[1] ^ Words(key0);
        counter[2] = high0 ^ counter[3] ^ Words(key1);
        counter[1] = low1;
        counter[3] = low0;
        key0 += 0x9e37'79b9;
        key1 += 0xbb67'ae85;
    }
    UniformsOf<Floats> result;
    for (int i = 0; i < 4; ++i)
        result.u[i] = to_float(Words(hn::ShiftRight<8>(counter[i].v))) * 0x1p-24f;
    return result;
}

} // namespace fast
