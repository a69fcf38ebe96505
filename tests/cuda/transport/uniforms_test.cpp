// The random numbers of the two wings are the same, except for the bits that a float cannot hold.

#include "cuda/transport/random.h"

#include "ref/transport/random.h"
#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace {

// The known answers of Random123 1.14 (kat_vectors): philox4x32, 10 rounds, all words 0.
TEST(UniformsInFloat, AreTheHighestBitsOfPhilox) // map: random-numbers
{
    const fast::Uniforms u = fast::uniforms({.seed = 0, .pixel = 0, .sample = 0}, fast::Event::camera);
    EXPECT_EQ(u[0], 0x6627e8p-24f);
    EXPECT_EQ(u[1], 0xe169c5p-24f);
    EXPECT_EQ(u[2], 0xbc57acp-24f);
    EXPECT_EQ(u[3], 0x9b00dbp-24f);
}

RC_GTEST_PROP(UniformsInFloat, AreThoseOfTheReferenceRoundedDown, (std::uint64_t seed))
{
    using enum ref::Event;
    const std::uint32_t pixel = *transport_test::any_word();
    const std::uint32_t sample = *transport_test::any_word();
    const std::uint32_t vertex = *transport_test::any_word() >> 8;
    for (const ref::Event event :
         {camera, emission_position, emission_direction, eye_bounce, light_bounce, next_event}) {
        const ref::Uniforms expected = ref::uniforms({seed, pixel, sample}, event, vertex);
        const fast::Uniforms u = fast::uniforms(
            {seed, pixel, sample}, static_cast<fast::Event>(static_cast<std::uint32_t>(event)), vertex);
        for (int i = 0; i < 4; ++i) {
            const double of_reference = expected[static_cast<std::size_t>(i)];
            RC_ASSERT(static_cast<double>(u[i]) == std::floor(of_reference * 0x1p24) * 0x1p-24);
            RC_ASSERT(u[i] < 1.0f);
        }
    }
}

static_assert(static_cast<int>(fast::Event::camera) == static_cast<int>(ref::Event::camera) &&
              static_cast<int>(fast::Event::emission_position) ==
                  static_cast<int>(ref::Event::emission_position) &&
              static_cast<int>(fast::Event::emission_direction) ==
                  static_cast<int>(ref::Event::emission_direction) &&
              static_cast<int>(fast::Event::eye_bounce) == static_cast<int>(ref::Event::eye_bounce) &&
              static_cast<int>(fast::Event::light_bounce) ==
                  static_cast<int>(ref::Event::light_bounce) &&
              static_cast<int>(fast::Event::next_event) == static_cast<int>(ref::Event::next_event));

} // namespace
