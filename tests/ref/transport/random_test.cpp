#include "ref/transport/random.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace {

using ref::Event;
using ref::uniforms;

// The known answers of Random123 1.14 (kat_vectors): philox4x32, 10 rounds, all words 0.
TEST(Random, IsPhiloxWithTenRounds) // map: random-numbers
{
    const auto u = uniforms({.seed = 0, .pixel = 0, .sample = 0}, Event::camera);
    EXPECT_EQ(u[0], (0x6627e8d5 + 0.5) * 0x1p-32);
    EXPECT_EQ(u[1], (0xe169c58d + 0.5) * 0x1p-32);
    EXPECT_EQ(u[2], (0xbc57ac4c + 0.5) * 0x1p-32);
    EXPECT_EQ(u[3], (0x9b00dbd8 + 0.5) * 0x1p-32);
}

RC_GTEST_PROP(Random, StaysInsideTheOpenUnitInterval, (std::uint64_t seed, std::uint32_t pixel))
{
    for (const double u : uniforms({seed, pixel, 0}, Event::eye_bounce, 3))
        RC_ASSERT(u > 0.0 && u < 1.0);
}

// If one of them were not part of the counter, two decisions would share their numbers (a correlation
// that no picture shows).
RC_GTEST_PROP(Random, DependsOnEverythingThatNamesADecision,
              (std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample))
{
    const auto j = *rc::gen::inRange(0u, 1u << 24);
    std::set<ref::Uniforms> all;
    for (const auto event : {Event::camera, Event::emission_position, Event::emission_direction,
                             Event::eye_bounce, Event::light_bounce, Event::next_event})
        for (const std::uint32_t vertex : {j, j ^ 1u})
            all.insert(uniforms({seed, pixel, sample}, event, vertex));
    all.insert(uniforms({seed ^ 1u, pixel, sample}, Event::camera, j));
    all.insert(uniforms({seed ^ 1ull << 63, pixel, sample}, Event::camera, j));
    all.insert(uniforms({seed, pixel ^ 1u, sample}, Event::camera, j));
    all.insert(uniforms({seed, pixel, sample ^ 1u}, Event::camera, j));
    RC_ASSERT(all.size() == 16u);
}

} // namespace
