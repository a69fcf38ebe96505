// judge_renders: prints a table of verdicts on renders by the reference, right ones and wrong ones.
//
// The calibration with simulated noise (tests/calibration) counts millions of trials of a simulated
// renderer; this program counts hundreds of trials of a real one.

#include "cli/progress.h"
#include "golden/compare.h"
#include "ref/transport/renderer.h"
#include "scenes/read_scene.h"
#include "tests/renders/mistakes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace renders_test;

constexpr int side = 32; // pixels
constexpr std::uint64_t golden_seed = 1;
constexpr double specification =
    0.007; // detectable relative error of the whole picture that a PASS needs

struct Case {
    const char* scene;
    std::uint32_t batch_size; // so that a PASS is possible
    int right, wrong;         // renders of each kind
};
constexpr std::array cases = {Case{"point_over_plane", 4, 67, 12}, Case{"near_occluder", 4, 67, 12},
                              Case{"all_emitters", 12, 67, 12}};

/// The picture of a camera that is shifted by half a pixel to the side, computed from a picture of twice
/// the resolution: each column takes one fine column from its right neighbour. The last column has no
/// such neighbour and is not shifted.
images::Image shifted(const images::Image& fine)
{
    images::Image image(fine.width / 2, fine.height / 2);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int left = std::min(2 * x + 1, fine.width - 2);
            images::Rgb sum(0.0);
            for (const int fy : {2 * y, 2 * y + 1})
                for (const int fx : {left, left + 1}) sum += fine.at(fx, fy);
            image.at(x, y) = sum / 4.0;
        }
    return image;
}

struct Kind {
    const char* name;
    ref::Integrator integrator;
    bool shift = false;
};
const std::array kinds = {Kind{"right", ref::trace_bidirectionally},
                          Kind{"1% too dark", altered<dim_by_one_percent>},
                          Kind{"(1, 2) dropped", altered<drop_next_event>},
                          Kind{"(2, 2) dropped", altered<drop_inner_connection>},
                          Kind{"half a pixel aside", ref::trace_bidirectionally, true},
                          Kind{"splats not scaled", altered<scale_splats>},
                          Kind{"weights 1/(s+t)", altered<weigh_uniformly>}};

struct Verdicts {
    int pass = 0, fail = 0, inconclusive = 0;
};

class Renders {
public:
    explicit Renders(const Case& what)
        : case_(what), scene_(scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes" /
                                                 (std::string(what.scene) + ".dae"))),
          world_(scene_, side, side), fine_(scene_, 2 * side, 2 * side)
    {
        golden::GoldenMaker maker(side, side, 64);
        for (std::uint64_t i = 0; i < 64 + 512; ++i) maker.add_batch(batch(kinds[0], golden_seed, i));
        golden_.emplace(maker.golden({{"batch_size", std::to_string(what.batch_size)}}));
    }

    Verdicts judge(const Kind& kind, int trials, const std::function<void()>& tick)
    {
        golden::CompareOptions options;
        options.specification = specification;
        Verdicts verdicts;
        for (int trial = 0; trial < trials; ++trial) {
            const std::uint64_t seed = 1000 + 10 * static_cast<std::uint64_t>(trial);
            const auto comparison = golden::compare(
                *golden_,
                [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
                    for (std::uint64_t i = 0; i < batches; ++i)
                        candidate.add_batch(batch(kind, seed + stage, i));
                },
                golden::Method::ranks, options);
            if (comparison.verdict == golden::Verdict::pass) ++verdicts.pass;
            if (comparison.verdict == golden::Verdict::fail) ++verdicts.fail;
            if (comparison.verdict == golden::Verdict::inconclusive) ++verdicts.inconclusive;
            tick();
        }
        return verdicts;
    }

    [[nodiscard]] double detectable() const
    {
        const auto errors = golden::detectable_error(*golden_, 64);
        return *std::max_element(errors.begin(), errors.end());
    }

private:
    [[nodiscard]] images::Image batch(const Kind& kind, std::uint64_t seed, std::uint64_t number) const
    {
        images::RenderOptions options{.seed = seed, .max_edges = 6};
        options.batch_size = kind.shift ? case_.batch_size / 4 : case_.batch_size;
        const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
        const ref::World& world = kind.shift ? fine_ : world_;
        images::Image image =
            ref::renderer(world, kind.integrator, options, threads)->render_batch(number)->mean;
        return kind.shift ? shifted(image) : image;
    }

    Case case_;
    scenes::Scene scene_;
    ref::World world_, fine_;
    std::optional<golden::Golden> golden_;
};

void print_table()
{
    double total = 0.0;
    for (const Case& c : cases) total += c.right + (kinds.size() - 1.0) * c.wrong;
    cli::Progress progress("renders", 0.0, total, false);
    double done = 0.0;
    std::string table = "| scene, samples per pixel | detectable error |";
    std::string line = "|---|---|";
    for (const Kind& kind : kinds) {
        table += std::string(" ") + kind.name + " |";
        line += "---|";
    }
    table += "\n" + line + "\n";
    for (const Case& c : cases) {
        Renders renders(c);
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), " %.2f%% |", 100.0 * renders.detectable());
        table +=
            "| " + std::string(c.scene) + ", " + std::to_string(64 * c.batch_size) + " |" + text.data();
        for (const Kind& kind : kinds) {
            const Verdicts v = renders.judge(kind, &kind == kinds.data() ? c.right : c.wrong,
                                             [&] { progress.update(++done); });
            table += " " + std::to_string(v.pass) + " / " + std::to_string(v.fail) + " / " +
                     std::to_string(v.inconclusive) + " |";
        }
        table += "\n";
    }
    std::printf("%s", table.c_str());
}

} // namespace

int main()
{
    try {
        print_table();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "judge_renders: %s\n", error.what());
        return 2;
    }
}
