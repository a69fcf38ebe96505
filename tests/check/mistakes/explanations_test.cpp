// Wrong pictures of all kinds against all explanations: each gets its own, and no other.

#include "check/mistakes/explanations.h"

#include "golden/compare.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/renderer.h"
#include "tests/check/mistakes/rooms.h"
#include "tests/check/mistakes/wrong_renderers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace {

using mistakes_test::WrongPicture;

constexpr int longest = 3; // edges
constexpr std::uint32_t samples = 96;

/// A scene with its golden and its explanations.
class Explained {
public:
    Explained(scenes::Scene scene, int size, double specification)
        : scene_(std::move(scene)), world_(scene_, size, size),
          explanations_(scene_, size, size, {.seed = 3, .max_edges = longest}, 2,
                        {.batch_samples = static_cast<std::uint32_t>(8 * size * size),
                         .first_batches = samples / 8,
                         .most_batches = samples / 8}),
          golden_(golden_of(world_))
    {
        explanations_.render();
        options_.specification = specification;
    }
    [[nodiscard]] const ref::World& world() const { return world_; }

    /// The verdict, and the diagnosis if it is not PASS.
    [[nodiscard]] std::pair<golden::Verdict, std::string> diagnosis(const images::Image& picture) const
    {
        const auto verdict = golden::compare_picture(golden_, picture, samples, options_).verdict;
        if (verdict == golden::Verdict::pass) return {verdict, ""};
        bool first = true;
        const auto once = [&]() -> std::vector<golden::Explanation> {
            if (!std::exchange(first, false)) return {};
            return explanations_.explanations(picture, golden_.mean);
        };
        return {verdict, golden::explain(golden_, {picture}, samples, once, options_)};
    }

private:
    static golden::Golden golden_of(const ref::World& world)
    {
        golden::GoldenMaker maker(world.camera.width(), world.camera.height(), 32);
        images::RenderOptions options;
        options.seed = 1;
        options.max_edges = longest;
        options.batch_size = 1;
        const auto renderer = ref::renderer(world, ref::trace_bidirectionally, options, 2);
        for (std::uint64_t batch = 0; batch < 128; ++batch)
            maker.add_batch(renderer->render_batch(batch)->mean);
        return maker.golden({{"batch_size", "1"}});
    }

    scenes::Scene scene_;
    ref::World world_;
    check::SceneExplanations explanations_;
    golden::Golden golden_;
    golden::CompareOptions options_;
};

/// Expects that every wrong picture gets its own diagnosis; of those in `alike`, together with another
/// one.
void expect_own_diagnosis(const Explained& explained, const std::vector<WrongPicture>& pictures,
                          const std::vector<std::string>& alike)
{
    EXPECT_EQ(explained.diagnosis(pictures.front().image).first, golden::Verdict::pass);
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        const auto [verdict, sentence] = explained.diagnosis(pictures[i].image);
        EXPECT_NE(verdict, golden::Verdict::pass) << pictures[i].is;
        EXPECT_NE(sentence.find(pictures[i].is), std::string::npos)
            << pictures[i].is << "\n  got: " << sentence;
        const bool known_alike = std::ranges::find(alike, pictures[i].is) != alike.end();
        EXPECT_EQ(sentence.find(", or ") != std::string::npos, known_alike) << sentence;
    }
}

TEST(SceneExplanations, EachMistakeOfStrategiesLengthsAndWeightsGetsItsOwn)
{
    const Explained explained(mistakes_test::room_with_mirror(), 32, 0.04);
    expect_own_diagnosis(explained,
                         mistakes_test::wrong_bidirectional(
                             explained.world(), {.seed = 2, .max_edges = longest + 1}, samples),
                         {"without the light of emitters that are seen directly",
                          "one in which emitters that are seen directly count twice",
                          "one without strategy (s, t) = (0, 4)"});
    expect_own_diagnosis(
        explained,
        mistakes_test::wrong_path_tracing(explained.world(), {.seed = 2, .max_edges = longest}, samples),
        {});
}

TEST(SceneExplanations, EachMistakeOfRefractionGetsItsOwn)
{
    const Explained explained(mistakes_test::room_with_glass(), 24, 0.1);
    expect_own_diagnosis(
        explained,
        mistakes_test::wrong_refraction(explained.world(), {.seed = 2, .max_edges = longest}, samples),
        {});
}

} // namespace
