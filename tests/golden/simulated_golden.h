#pragma once

// One golden of a simulated picture for all tests of comparisons, and candidates for it. All seeds are
// fixed, so the results are always the same. At the given levels, a right picture is suspected by chance
// for at most one seed in 20.

#include "golden/compare.h"
#include "tests/calibration/simulated_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace golden_test {

inline constexpr int size = 32; // pixels per side
inline const images::Metadata metadata = {{"batch_size", "4"}, {"scene_hash", "abc"}, {"seed", "1"}};

/// Options with a specified error that is detectable with 32x32 pixels.
inline golden::CompareOptions for_small_pictures()
{
    golden::CompareOptions options;
    options.specification = 0.02;
    return options;
}

class SimulatedGolden : public ::testing::Test {
protected:
    static const calibration::SimulatedRenderer& renderer()
    {
        static const calibration::SimulatedRenderer instance(size, calibration::Noise::lognormal);
        return instance;
    }
    /// A golden of 256 pilot batches and 512 reference batches.
    static const golden::Golden& reference()
    {
        static const golden::Golden instance = [] {
            golden::GoldenMaker maker(size, size, 256);
            for (std::uint64_t batch = 0; batch < 768; ++batch)
                maker.add_batch(renderer().render(1, batch));
            return maker.golden(metadata);
        }();
        return instance;
    }
    static golden::Candidate candidate(const calibration::Bias& bias = {}, std::uint64_t batches = 64,
                                       std::uint64_t seed = 2)
    {
        golden::Candidate result(reference().functionals);
        for (std::uint64_t batch = 0; batch < batches; ++batch)
            result.add_batch(renderer().render(seed, batch, bias));
        return result;
    }
    /// A picture of `batches` batches, of 4 samples each.
    static images::Image picture(std::uint64_t batches, std::uint64_t seed,
                                 const calibration::Bias& bias = {})
    {
        images::Film film(size, size);
        for (std::uint64_t batch = 0; batch < batches; ++batch)
            film.add_batch(renderer().render(seed, batch, bias));
        return film.mean();
    }
    /// Stages of the simulated renderer, each with its own bias. Further stages have the last bias.
    static golden::RenderStage stages(const std::vector<calibration::Bias>& biases)
    {
        return [biases](std::size_t stage, std::uint64_t batches, golden::Candidate& result) {
            for (std::uint64_t batch = 0; batch < batches; ++batch)
                result.add_batch(
                    renderer().render(10 + stage, batch, biases[std::min(stage, biases.size() - 1)]));
        };
    }
};

} // namespace golden_test
