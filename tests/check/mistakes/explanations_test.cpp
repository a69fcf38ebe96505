// Wrong pictures of all kinds against all explanations: each gets its own, and no other.

#include "check/mistakes/explanations.h"

#include "golden/compare.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/renderer.h"
#include "scenes/read_scene.h"
#include "tests/check/mistakes/wrong_renderers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

namespace {

using mistakes_test::WrongPicture;

/// A scene with its golden and its explanations.
class Explained {
public:
    struct Plan {
        const char* scene;
        int size;    // pixels per side
        int longest; // edges
        std::uint64_t golden_batches;
        std::uint32_t batch_size;
        std::uint64_t batches; // of the explanations
    };
    explicit Explained(const Plan& plan)
        : scene_(scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes" /
                                    (std::string(plan.scene) + ".dae"))),
          world_(scene_, plan.size, plan.size),
          explanations_(scene_, plan.size, plan.size, {.seed = 3, .max_edges = plan.longest}, 2,
                        {.batch_samples = static_cast<std::uint32_t>(plan.size * plan.size) * 64,
                         .first_batches = plan.batches,
                         .most_batches = plan.batches}),
          golden_(golden_of(world_, plan))
    {
        explanations_.render();
        options_.specification = 0.03;
    }
    [[nodiscard]] static golden::Golden golden_of(const ref::World& world, const Plan& plan)
    {
        golden::GoldenMaker maker(plan.size, plan.size, 32);
        images::RenderOptions options;
        options.seed = 1;
        options.max_edges = plan.longest;
        options.batch_size = plan.batch_size;
        const auto renderer = ref::renderer(world, ref::trace_bidirectionally, options, 2);
        for (std::uint64_t batch = 0; batch < plan.golden_batches; ++batch)
            maker.add_batch(renderer->render_batch(batch)->mean);
        return maker.golden({{"batch_size", std::to_string(plan.batch_size)}});
    }
    [[nodiscard]] const ref::World& world() const { return world_; }

    /// The verdict, and the sentence if it is not PASS.
    [[nodiscard]] std::pair<golden::Verdict, std::string> diagnosis(const images::Image& picture,
                                                                    double samples) const
    {
        const auto verdict = golden::compare_picture(golden_, picture, samples, options_).verdict;
        if (verdict == golden::Verdict::pass) return {verdict, ""};
        bool first = true;
        return {verdict, golden::explain(
                             golden_, {picture}, samples,
                             [&]() -> std::vector<golden::Explanation> {
                                 if (!std::exchange(first, false)) return {};
                                 return explanations_.explanations(picture, golden_.mean);
                             },
                             options_)};
    }

private:
    scenes::Scene scene_;
    ref::World world_;
    check::SceneExplanations explanations_;
    golden::Golden golden_;
    golden::CompareOptions options_;
};

TEST(Explore, Matrix)
{
    const char* scene = std::getenv("SCENE");
    const int longest = std::atoi(std::getenv("EDGES"));
    const int samples = std::atoi(std::getenv("SAMPLES"));
    const Explained explained({scene, 12, longest, 224, 4, static_cast<std::uint64_t>(samples / 64)});
    std::printf("made\n");
    std::vector<WrongPicture> all;
    const auto take = [&](std::vector<WrongPicture> more) {
        for (auto& picture : more) all.push_back(std::move(picture));
    };
    take(mistakes_test::wrong_bidirectional(explained.world(), {.seed = 2, .max_edges = longest + 1},
                                            samples));
    take(mistakes_test::wrong_path_tracing(explained.world(), {.seed = 2, .max_edges = longest},
                                           samples));
    take(mistakes_test::wrong_refraction(explained.world(), {.seed = 2, .max_edges = longest}, samples));
    for (const WrongPicture& picture : all) {
        const auto [verdict, sentence] = explained.diagnosis(picture.image, samples);
        const bool good = sentence.rfind("Your picture is " + picture.is, 0) == 0;
        std::printf("%-5s %-12s %-60.60s | %.240s\n", good ? "OK" : sentence.empty() ? "-" : "WRONG",
                    golden::describe(verdict).c_str(), picture.is.c_str(), sentence.c_str());
    }
}

} // namespace
