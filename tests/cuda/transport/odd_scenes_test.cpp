// Odd scenes from seeds: all integrators of both wings are compared with a truth that comes from none
// of them, and with each other. A failure names its seed: PLUMBLINE_ODD_SEED=n renders only that
// scene, and prints the result of each integrator.
//
// The truth is a number that is known exactly (furnaces; direct light on a plane). For rooms it is the
// sum of two pictures by the reference, each with half of the lamps and without the additions that
// change nothing. So a lamp that is preferred or neglected beside others is not so in its own picture.
//
// A comparison is a t test on the means of whole pictures over 32 independent batches. The bound of 7
// standard errors with 31 degrees of freedom is exceeded by chance once in 10^7 times, if the means of
// batches are normally distributed; a batch is 256 samples. A scene is compared at most 9 times:
// 20,000 scenes fail by chance with a probability of 2%.
//
// Light that was never found is missing in the standard error too. The standard error of path tracing
// and of bidirectional path tracing must be below a tenth of the truth; with the bound above, their
// means are then correct within a factor, even if they missed light. Light tracing is noisy where only
// a small part of the lit surfaces is in view: it is compared with the truth only if its standard
// error is below a tenth of its own mean; the two wings are compared in any case. If the first samples
// are too few for these limits, 16 times as many are taken, and only these are tested.
//
// Where two strategies share paths, one of them may sample them so seldom that it found none. One such
// event is worth about as much as a sample of the other, since its weight is as small as its density:
// with the balance heuristic no strategy adds more than f / (p1 + p2). With 16 expected events, all
// are missed with a probability of e^-16 = 1e-7. So the truth has a tolerance of 16 / (samples of the
// picture), 0.2%.

#include "tests/cuda/transport/batch_means.h"
#include "tests/cuda/transport/odd_scenes.h"

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

using fast_transport_test::average;
using fast_transport_test::error_of;
using fast_transport_test::Means;
using fast_transport_test::OddScene;

constexpr double bound = 7;
constexpr double largest_error = 0.1; // relative
constexpr std::uint32_t more = 16;    // factor for the samples where the error is larger

constexpr std::uint32_t groups = 20; // of scenes, all of one kind; the number of tests
constexpr fast_transport_test::Samples samples{
    .size = fast_transport_test::odd_size, .batches = 32, .batch_size = 4};

/// One of the three integrators, in both wings.
struct Both {
    const char* name;
    ref::Integrator ref;
    fast::Integrator host;
    bool sure; // finds all light with a variance that is not large
};

struct Truth {
    double mean;
    double error; // standard error of it
};

bool shows_scene()
{
    return std::getenv("PLUMBLINE_ODD_SEED") != nullptr;
}

void show(const std::string& what, double mean, double error)
{
    if (shows_scene()) std::cout << what << ' ' << mean << " +- " << error << '\n';
}

fast_transport_test::Samples times(std::uint32_t factor)
{
    fast_transport_test::Samples all = samples;
    all.batch_size *= factor;
    return all;
}

Truth truth_of(const OddScene& odd, std::uint64_t seed)
{
    if (odd.mean) return {*odd.mean, 0};
    Truth truth{0, 0};
    const ref::Integrator integrator = odd.path_sees ? ref::trace_path : ref::trace_bidirectionally;
    for (const std::uint32_t factor : {1u, more}) {
        truth = {0, 0};
        for (const scenes::Scene& part : odd.parts) {
            const Means means = fast_transport_test::means_by_ref(part, integrator, odd.max_edges,
                                                                  ++seed, times(factor));
            truth.mean += average(means);
            truth.error = std::hypot(truth.error, error_of(means));
        }
        if (truth.error <= largest_error * truth.mean) break;
    }
    return truth;
}

void expect_truth(const Means& means, const Truth& truth, double tolerance, const std::string& what)
{
    const double error = error_of(means);
    show(what, average(means), error);
    EXPECT_LE(std::abs(average(means) - truth.mean),
              bound * std::hypot(error, truth.error) + tolerance * truth.mean)
        << what << ": " << average(means) << ", truth " << truth.mean << ", standard error " << error;
}

/// From the same random numbers: differences come only from paths that rounding changes.
void expect_equal_wings(const Means& host, const Means& ref, double tolerance, const std::string& what)
{
    Means differences;
    for (std::size_t i = 0; i < ref.size(); ++i) differences.push_back(host[i] - ref[i]);
    show(what + ", host - ref:", average(differences), error_of(differences));
    EXPECT_LE(std::abs(average(differences)), bound * error_of(differences) + tolerance * average(ref))
        << what << ", wings: " << average(host) << ", " << average(ref);
}

/// Compares both wings with the truth and with each other. Uses the seeds `number` and `number` + 1.
void expect_right(const OddScene& odd, const Both& integrator, const Truth& truth, std::uint64_t number)
{
    const std::string name = integrator.name;
    Means ref;
    bool enough = false;
    std::uint32_t factor = 1;
    for (const std::uint32_t tried : {1u, more}) {
        factor = tried;
        ref = fast_transport_test::means_by_ref(odd.scene, integrator.ref, odd.max_edges, ++number,
                                                times(factor));
        const double scale = integrator.sure ? truth.mean : average(ref);
        enough = scale > 0 && error_of(ref) <= largest_error * scale;
        if (enough) break;
    }
    const Means host = fast_transport_test::means_by_host(odd.scene, integrator.host, odd.max_edges,
                                                          number, times(factor));
    expect_equal_wings(host, ref, odd.float_tolerance, name);
    if (integrator.sure) {
        EXPECT_TRUE(enough) << name << " by ref is too noisy: " << average(ref) << ", standard error "
                            << error_of(ref) << ", truth " << truth.mean;
        EXPECT_LE(error_of(host), largest_error * truth.mean) << name << " by host is too noisy";
    } else if (!enough) {
        return;
    }
    const double rare =
        16.0 / (fast_transport_test::odd_size * fast_transport_test::odd_size * 32.0 * 4 * factor);
    expect_truth(ref, truth, rare, name + " by ref");
    expect_truth(host, truth, rare + odd.float_tolerance, name + " by host");
}

void expect_right(std::uint32_t seed)
{
    const OddScene odd = fast_transport_test::odd_scene(seed);
    SCOPED_TRACE("PLUMBLINE_ODD_SEED=" + std::to_string(seed) + " (" + odd.description + ')');
    const Truth truth = truth_of(odd, seed);
    show(odd.description + "\ntruth", truth.mean, truth.error);
    ASSERT_GT(truth.mean, 0);
    EXPECT_LE(truth.error, largest_error * truth.mean);

    std::vector<Both> all = {{"bdpt", ref::trace_bidirectionally, fast::Integrator::bdpt, true}};
    if (odd.path_sees) all.push_back({"path", ref::trace_path, fast::Integrator::path, true});
    if (odd.light_sees) all.push_back({"light", ref::trace_light, fast::Integrator::light, false});
    std::uint64_t number = 1000000ull * seed;
    for (const Both& integrator : all) expect_right(odd, integrator, truth, number += 10);
}

/// The scenes of one group.
class OddScenes : public testing::TestWithParam<std::uint32_t> {};

TEST_P(OddScenes, AreRenderedRight)
{
    const std::uint32_t group = GetParam();
    if (const char* one = std::getenv("PLUMBLINE_ODD_SEED")) {
        const auto seed = static_cast<std::uint32_t>(std::strtoul(one, nullptr, 10));
        if (seed % groups != group) GTEST_SKIP() << "not the group of that seed";
        return expect_right(seed);
    }
    const std::uint32_t scenes = std::getenv("PLUMBLINE_LONG") != nullptr ? 20000 : 100;
    for (std::uint32_t seed = group; seed < scenes; seed += groups) expect_right(seed);
}

static_assert(groups % fast_transport_test::odd_kinds ==
              0); // so that all scenes of a group are of one kind

INSTANTIATE_TEST_SUITE_P(Seeds, OddScenes, testing::Range(0u, groups),
                         [](const testing::TestParamInfo<std::uint32_t>& group) {
                             return fast_transport_test::name_of(
                                        fast_transport_test::odd_kind(group.param)) +
                                    std::to_string(group.param / fast_transport_test::odd_kinds);
                         });

} // namespace
