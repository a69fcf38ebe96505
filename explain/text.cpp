#include "explain/text.h"

#include "explain/layout.h"
#include "explain/names.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace explain {

namespace {

constexpr std::size_t columns = 100;

/// Appends `words` to lines that begin with `indent` spaces.
void add_wrapped(std::string& text, const std::string& first, const std::vector<std::string>& words,
                 std::size_t indent)
{
    std::string line = first;
    for (const std::string& word : words) {
        if (line.size() + 1 + word.size() > columns) {
            text += line + "\n";
            line = std::string(indent, ' ');
        }
        line += (line.empty() || line.back() == ' ' ? "" : " ") + word;
    }
    text += line + "\n";
}

std::string draws_text(const Sample& sample)
{
    std::string text = "\nRandom numbers: event, vertex, then word, number and what it decides\n";
    for (const Draw& draw : sample.draws) {
        std::vector<std::string> words;
        for (std::size_t i = 0; i < 4; ++i) {
            if (draw.use[i] == nullptr) continue;
            std::array<char, 64> word{};
            (void)std::snprintf(word.data(), word.size(), " [%zu] %.10f %s", i, draw.uniforms[i],
                                draw.use[i]);
            words.emplace_back(word.data());
        }
        const bool has_vertex = draw.event >= ref::Event::eye_bounce;
        add_wrapped(text,
                    padded("  " + padded(std::string(name_of(draw.event)), 19) +
                               (has_vertex ? std::to_string(draw.vertex) : "-"),
                           24),
                    words, 24);
    }
    return text;
}

std::string density_text(const Step& step)
{
    std::vector<std::string> parts;
    if (step.probability) parts.push_back("probability " + number(*step.probability));
    if (step.pdf_solid_angle) parts.push_back("pdf_solid_angle " + number(*step.pdf_solid_angle));
    if (step.pdf_area) parts.push_back("pdf_area " + number(*step.pdf_area));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
}

std::string bounce_text(const Bounce& bounce)
{
    if (bounce.sample.value == Rgb(0.0)) return "";
    std::string text = bounce.sample.delta ? "delta lobe, probability " : "bounce, pdf_fwd ";
    text += number(bounce.sample.pdf_fwd);
    if (!bounce.sample.delta) text += ", pdf_rev " + number(bounce.sample.pdf_rev);
    if (bounce.survival < 1.0) text += ", goes on with probability " + number(bounce.survival);
    return text;
}

std::string walk_text(const ref::World& world, const Walk& walk, char letter)
{
    std::string text = letter == 'z' ? "\nEye walk, " : "\nLight walk, ";
    text += plural(walk.steps.size(), "vertex", "vertices") +
            "; it ends: " + std::string(sentence(walk.end)) + "\n";
    for (std::size_t j = 0; j < walk.steps.size(); ++j) {
        const Step& step = walk.steps[j];
        const ref::Vertex& vertex = step.vertex;
        const bool far = vertex.kind == ref::Vertex::Kind::infinity;
        text += "  " + padded(std::string(1, letter) + "_" + std::to_string(j), 5) +
                describe(world.scene, vertex) + "\n";
        const bool surface = vertex.kind == ref::Vertex::Kind::surface;
        text += trimmed("       " +
                        padded(far ? "towards " + numbers(vertex.towards)
                                   : "position " + numbers(vertex.point.position),
                               44) +
                        (surface ? "normal " + numbers(vertex.point.normal) : std::string()));
        text += trimmed("       " + padded("alpha " + numbers(vertex.alpha), 44) + density_text(step));
        if (step.bounce && !bounce_text(*step.bounce).empty())
            text += "       " + bounce_text(*step.bounce) + "\n";
    }
    return text;
}

std::string strategies_text(const ref::World& world, const Sample& sample)
{
    const std::vector<std::size_t> widths = {5, 3, 17, 30, 10, 10};
    std::string text =
        "\nStrategies: s vertices of the light walk, t of the eye walk\n" +
        row({"  s", "t", "family", "value alone (R G B)", "balance", "power", "adds"}, widths);
    for (const Strategy& strategy : sample.strategies) {
        std::vector<std::string> cells = {"  " + std::to_string(strategy.s), std::to_string(strategy.t),
                                          std::string(family_of(strategy))};
        if (strategy.made && !strategy.is_dropped())
            cells.insert(cells.end(),
                         {short_numbers(strategy.made->value), short_number(strategy.balance),
                          short_number(strategy.power), short_numbers(strategy.contribution())});
        else
            cells.push_back("- " + sentence(strategy, world.scene));
        text += row(cells, widths);
    }
    return text;
}

/// A density that may be beyond double.
std::string number(long double x)
{
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), "%.4Lg", x);
    return text.data();
}

std::string densities_text(const Sample& sample)
{
    const bool path = sample.integrator == images::Integrator::path;
    std::string text;
    for (const Strategy& strategy : sample.strategies) {
        if (strategy.densities.empty()) continue;
        std::vector<std::string> words;
        for (const Density& density : strategy.densities)
            words.push_back("p_" + std::to_string(density.s) + " " + number(density.value) + " (" +
                            number(density.relative) + ")" +
                            (&density == &strategy.densities.back() ? "" : ","));
        add_wrapped(
            text,
            padded("  (" + std::to_string(strategy.s) + "," + std::to_string(strategy.t) + ")", 10),
            words, 10);
    }
    if (text.empty()) return "";
    return (path ? "\nDensities of the last edge by each strategy, per solid angle"
                 : "\nDensities p_i of the path by each strategy (i,k+1-i)") +
           std::string("; in brackets p_i / p_s\n") + text;
}

std::string sums_text(const ref::World& world, const Sample& sample)
{
    const int width = world.camera.width();
    std::string text =
        "\nAdds to its pixel " + pixel_name(sample.id.pixel, width) + ": " + numbers(sample.own) + "\n";
    for (const Strategy& strategy : sample.strategies)
        if (strategy.made && strategy.t == 1 && !strategy.is_dropped())
            text += "Adds to pixel " + pixel_name(strategy.made->pixel, width) + ": " +
                    numbers(strategy.contribution()) + " (splat of strategy (" +
                    std::to_string(strategy.s) + ",1))\n";
    return text;
}

} // namespace

std::string describe(const ref::World& world, const Sample& sample)
{
    std::string text = heading(world, sample) + draws_text(sample) + walk_text(world, sample.eye, 'z');
    if (sample.light.end != WalkEnd::not_walked) text += walk_text(world, sample.light, 'y');
    return text + strategies_text(world, sample) + densities_text(sample) + sums_text(world, sample);
}

} // namespace explain
