// A study in rounds, its results, and going on with it: on simulated configurations.

#include "tests/trade/simulated.h"
#include "trade/results.h"
#include "trade/resume.h"
#include "trade/study.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace {

using namespace trade_test;

/// Three configurations, of which `noisy` needs four times the samples of `base`, and `biased` is 5% too
/// bright.
struct Example {
    Machine machine{std::mt19937_64(7)};
    trade::Truth truth = simulated_truth(machine, 256);
    std::vector<trade::Configuration> configurations = {
        {"base", "render base", make({0.0, 1.0, 1e-3, 1e-2}, machine)},
        {"noise=4", "render noisy", make({0.0, 4.0, 1e-3, 1e-2}, machine)},
        {"noise=biased", "render biased", make({0.05, 1.0, 1e-3, 1e-2}, machine)}};
    std::vector<trade::Knob> knobs = {
        {"noise", "how noisy it is", 0, {{"1", 0}, {"4", 1}, {"biased", 2}}}};
    trade::StudyOptions options{12.0, 4, 1, 0.0};
    trade::Description description;
    std::vector<trade::Measurements> measured;

    bool run(const trade::StudyMonitor& monitor = {})
    {
        return trade::study(configurations, options, truth, clock_of(machine), monitor, measured);
    }
    [[nodiscard]] trade::Json results() const
    {
        return trade::results(description, options, configurations, knobs, truth, measured);
    }
};

TEST(Study, MeasuresEveryConfigurationOnceARoundInAboutTheTimeGiven)
{
    Example example;
    int kept = 0;
    double progress = 0.0;
    const double start = example.machine.now.wall;
    ASSERT_TRUE(example.run({[&](double done) { progress = done; }, {}, [&] { ++kept; }}));
    for (const trade::Measurements& of_one : example.measured) {
        EXPECT_EQ(of_one.rounds.size(), 4U);
        EXPECT_EQ(of_one.problem, "");
        EXPECT_GE(of_one.plan->batches, trade::fewest_batches);
        EXPECT_EQ(of_one.picture.substr(1, 3), "PNG");
    }
    EXPECT_EQ(kept, 4);
    EXPECT_EQ(progress, 1.0);
    EXPECT_NEAR(example.machine.now.wall - start, 12.0, 4.0); // with the search for plans
}

// Equal seeds in all rounds would make each round the same picture, and all intervals too narrow. An
// order that does not change would favour the same configuration in every round.
TEST(Study, PlansByTheSpeedOfAConfigurationThatHasRenderedBefore)
{
    Machine machine{std::mt19937_64(7)};
    Simulated slow_at_first{0.0, 1.0, 1e-3, 1e-4};
    slow_at_first.cold = 0.2;
    const auto found = trade::plan_for(1.0, make(slow_at_first, machine), 1, clock_of(machine), {});
    ASSERT_TRUE(found);
    // The machine's scatter is 5%: six times as much.
    EXPECT_NEAR(static_cast<double>(found->batches * found->batch_size), 1000.0, 300.0);
}

TEST(Study, DrawsSeedsAndOrderAnewInEachRound)
{
    Example example;
    std::vector<std::pair<std::size_t, std::uint64_t>> measured; // configuration, seed
    for (std::size_t i = 0; i < 3; ++i)
        example.configurations[i].make = [&, i, inner = example.configurations[i].make](
                                             std::uint32_t batch_size, std::uint64_t seed) {
            measured.emplace_back(i, seed);
            return inner(batch_size, seed);
        };
    example.options.rounds = 8;
    ASSERT_TRUE(example.run());
    measured.erase(measured.begin(), measured.end() - 24); // the search for plans
    std::set<std::uint64_t> seeds;
    std::set<std::vector<std::size_t>> orders;
    for (std::size_t round = 0; round < 8; ++round) {
        std::vector<std::size_t> order;
        for (std::size_t k = 0; k < 3; ++k) {
            order.push_back(measured[3 * round + k].first);
            EXPECT_EQ(measured[3 * round + k].second, measured[3 * round].second);
        }
        EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 3U);
        seeds.insert(measured[3 * round].second);
        orders.insert(order);
    }
    EXPECT_EQ(seeds.size(), 8U);
    EXPECT_GE(orders.size(), 3U); // of 6; fewer in one of 1e4 cases, and the seed is fixed
}

TEST(Study, IsDescribedByItsResults)
{
    Example example;
    ASSERT_TRUE(example.run());
    const trade::Json json = example.results();
    const trade::Json& base = json.at("configurations").at(0);
    const trade::Json& noisy = json.at("configurations").at(1);
    const trade::Json& biased = json.at("configurations").at(2);
    EXPECT_TRUE(base.at("time_to_equal_noise").is_null());
    EXPECT_NEAR(noisy.at("time_to_equal_noise").at("value"), 4.0, 0.8);
    EXPECT_NEAR(noisy.at("speed").at("value"), 1.0, 0.2);
    EXPECT_EQ(base.at("bias").at("verdict"), "none found");
    EXPECT_EQ(biased.at("bias").at("verdict"), "biased");
    EXPECT_NEAR(biased.at("bias").at("whole").at("value"), 0.05, 0.005);
    EXPECT_NEAR(biased.at("floor"), relative_square(example.truth) * 0.05 * 0.05, 2e-4);
    EXPECT_EQ(base.at("floor"), 0.0);
    EXPECT_TRUE(base.at("front").get<bool>());
    EXPECT_FALSE(noisy.at("front").get<bool>());
    const std::string sentence = json.at("knobs").at(0).at("sentence");
    EXPECT_NE(sentence.find("noise=4 takes "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("biased: noise=biased, by +"), std::string::npos) << sentence;
    EXPECT_NE(trade::table(json).find("BIASED"), std::string::npos);
}

TEST(Study, SaysFromWhichNumberOfSamplesALongerBuildPays)
{
    Example example;
    example.machine.own_scatter = 0.005;
    example.configurations = {{"base", "render", make({0.0, 1.0, 2e-3, 0.05}, example.machine)},
                              {"tree=plain", "render", make({0.0, 1.0, 3e-3, 0.01}, example.machine)},
                              {"tree=best", "render", make({0.0, 1.0, 1e-3, 0.15}, example.machine)}};
    example.knobs = {{"tree", "of boxes", 0, {{"base", 0}, {"plain", 1}, {"best", 2}}}};
    ASSERT_TRUE(example.run());
    const trade::Json knob = example.results().at("knobs").at(0);
    EXPECT_NEAR(knob.at("values").at(1).at("reference_pays_from").at("value"), 40.0, 4.0);
    EXPECT_TRUE(knob.at("values").at(1).at("pays_from").at("value").is_null());
    EXPECT_NEAR(knob.at("values").at(2).at("pays_from").at("value"), 100.0, 10.0);
    const std::string sentence = knob.at("sentence");
    EXPECT_NE(sentence.find("tree=best reaches the error of tree=base in 0."), std::string::npos);
    EXPECT_NE(sentence.find("its longer build pays from "), std::string::npos) << sentence;
}

// Of equal configurations one in twenty intervals excludes 1. With 40 values there are two such, and the
// sentence must not name them.
TEST(Study, CallsNoneOfManyEqualConfigurationsFaster)
{
    int named = 0;
    int excluded = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Example example;
        example.machine.random.seed(seed);
        example.configurations = {{"base", "render", make({}, example.machine)}};
        example.knobs = {{"name", "of the same", 0, {{"0", 0}}}};
        for (std::size_t i = 1; i <= 40; ++i) {
            const std::string name = std::to_string(i);
            example.configurations.push_back({"name=" + name, "render", make({}, example.machine)});
            example.knobs[0].values.push_back({name, i});
        }
        ASSERT_TRUE(example.run());
        const trade::Json json = example.results();
        const std::string sentence = json.at("knobs").at(0).at("sentence");
        named += sentence.find("no difference is certain") == std::string::npos ? 1 : 0;
        for (const trade::Json& value : json.at("knobs").at(0).at("values")) {
            const trade::Json& time = value.at("time_to_equal_noise");
            if (time.is_null()) continue;
            excluded += time.at("low") > 1.0 || time.at("high") < 1.0 ? 1 : 0;
        }
    }
    EXPECT_LE(named, 4);     // expected: at most 1 of 20
    EXPECT_GE(excluded, 10); // expected: about 40 of 800
}

TEST(Study, GoesOnWhereItStopped)
{
    Example example;
    int measurements = 0;
    // Stopped in the second round: after two measurements of it.
    const auto stop = [&] { return measurements >= 5; };
    ASSERT_FALSE(example.run({[&](double) { ++measurements; }, stop, {}}));
    EXPECT_EQ(example.measured[0].rounds.size() + example.measured[1].rounds.size() +
                  example.measured[2].rounds.size(),
              5U);
    const trade::Json before = example.results();
    const std::vector<trade::Measurements> at_stop = example.measured;

    const trade::Json read = trade::Json::parse(before.dump());
    example.measured = trade::restored(read, example.description, example.options,
                                       example.configurations, example.truth);
    EXPECT_EQ(example.results().dump(), before.dump()); // not a digit is lost
    ASSERT_TRUE(example.run());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(example.measured[i].rounds.size(), 4U);
        EXPECT_EQ(trade::raw(example.measured[i].rounds[0]), trade::raw(at_stop[i].rounds[0]));
    }
}

TEST(Study, RefusesToGoOnWithAnother)
{
    Example example;
    ASSERT_TRUE(example.run());
    const trade::Json json = example.results();
    const auto restore = [&] {
        return trade::restored(json, example.description, example.options, example.configurations,
                               example.truth);
    };
    EXPECT_EQ(restore().size(), 3U);
    example.options.rounds = 5;
    EXPECT_THROW(restore(), std::invalid_argument);
    example.options.rounds = 4;
    example.description.scene_hash = "another";
    EXPECT_THROW(restore(), std::invalid_argument);
    example.description.scene_hash = "";
    for (const char* text : {"{}", "[]", "3", R"({"format": "another"})"})
        EXPECT_THROW(trade::restored(trade::Json::parse(text), example.description, example.options,
                                     example.configurations, example.truth),
                     std::invalid_argument)
            << text;
    trade::Json broken = json;
    broken["configurations"][0]["raw"][0].erase("noise");
    EXPECT_THROW(trade::restored(broken, example.description, example.options, example.configurations,
                                 example.truth),
                 std::invalid_argument);
}

TEST(Study, GoesOnWithoutAConfigurationThatFails)
{
    Example example;
    example.configurations[1].make = [](std::uint32_t,
                                        std::uint64_t) -> std::unique_ptr<images::Renderer> {
        throw std::runtime_error("no such device");
    };
    ASSERT_TRUE(example.run());
    EXPECT_EQ(example.measured[1].problem, "no such device");
    EXPECT_EQ(example.measured[2].rounds.size(), 4U);
    const trade::Json json = example.results();
    EXPECT_EQ(json.at("configurations").at(1).at("problem"), "no such device");
    EXPECT_NE(trade::table(json).find("not measured: no such device"), std::string::npos);
}

TEST(Study, SaysWhenAConfigurationIsTooSlow)
{
    Example example;
    example.configurations[1].make = make({0.0, 1.0, 10.0, 1e-2}, example.machine);
    ASSERT_TRUE(example.run());
    EXPECT_NE(example.measured[1].problem.find("too slow"), std::string::npos);
}

TEST(Study, SaysWhenTheMachineIsTooNoisy)
{
    Example quiet;
    ASSERT_TRUE(quiet.run());
    quiet.description.precision = 0.5;
    EXPECT_EQ(quiet.results().at("noise_of_machine").at("sentence").get<std::string>().find("too noisy"),
              std::string::npos);
    Example noisy;
    noisy.machine.own_scatter = 0.5;
    ASSERT_TRUE(noisy.run());
    noisy.description.precision = 0.1;
    EXPECT_NE(noisy.results().at("noise_of_machine").at("sentence").get<std::string>().find("too noisy"),
              std::string::npos);
}

} // namespace
