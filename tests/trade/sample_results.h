#pragma once

// Results such as `plumbline trade` measures, made up by a small model of a renderer.

#include "images/base64.h"
#include "images/png.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace trade_test {

using Json = nlohmann::ordered_json;

/// What the model knows of a configuration; `wrong` is the relative error of its mean.
struct SampleConfiguration {
    std::string knob;
    std::string value;
    double build = 0.002; // seconds
    double sample = 1e-3; // seconds per sample per pixel
    double noise = 0.8;   // relMSE of one sample per pixel
    double wrong = 0.0;
    std::string verdict = "none found";
    std::string problem = {};
};

inline Json sample_estimate(double value, double half_width)
{
    return {{"value", value}, {"low", value - half_width}, {"high", value + half_width}};
}

inline Json scaled_estimate(double value, double relative)
{
    return {{"value", value}, {"low", value * (1.0 - relative)}, {"high", value * (1.0 + relative)}};
}

/// A disc over a floor with the noise of `samples`.
inline std::string sample_picture(double noise, double samples, double brightness)
{
    std::mt19937 random(static_cast<unsigned>(1000.0 * noise + samples));
    std::normal_distribution<double> normal(0.0, std::sqrt(noise / samples));
    images::Image image;
    image.width = image.height = 64;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool inside = (x - 32) * (x - 32) + (y - 34) * (y - 34) < 260;
            const images::Rgb colour = inside   ? images::Rgb(0.7, 0.35, 0.15)
                                       : y > 44 ? images::Rgb(0.35, 0.38, 0.4)
                                                : images::Rgb(0.12, 0.2, 0.3) * (1.0 + y / 64.0);
            image.pixels.push_back(colour * brightness * std::max(0.0, 1.0 + normal(random)));
        }
    return images::base64(images::encode_png(image));
}

inline Json json_of(const SampleConfiguration& c, const SampleConfiguration& base,
                    double picture_seconds)
{
    const bool is_base = c.knob.empty();
    const std::string name = is_base ? "base" : c.knob + "=" + c.value;
    Json json = {{"name", name},
                 {"knob", c.knob},
                 {"value", c.value},
                 {"base", is_base},
                 {"command", "plumbline render scenes/cornell_glass.dae --size 64x64 --integrator bdpt" +
                                 (is_base ? std::string() : " --" + c.knob + " " + c.value)},
                 {"problem", nullptr}};
    if (!c.problem.empty()) {
        json["problem"] = c.problem;
        return json;
    }
    // Intervals of different widths, from the name alone.
    const double spread = 0.02 + 0.05 * static_cast<double>(std::hash<std::string>()(name) % 97) / 97.0;
    const double ratio = c.noise * c.sample / (base.noise * base.sample);
    const double samples = std::max(1.0, std::floor(picture_seconds / c.sample));
    json["batches"] = 256;
    json["batch_size"] = 4;
    json["build"] = {{"wall", scaled_estimate(c.build, spread)},
                     {"cpu", scaled_estimate(c.build * 1.7, spread)}};
    json["render"] = {{"wall", scaled_estimate(c.sample, spread)},
                      {"cpu", scaled_estimate(c.sample * 1.95, spread)}};
    const double unsure = c.verdict == "undecided" ? 0.03 : 0.0015;
    json["bias"] = {{"verdict", c.verdict},
                    {"whole", sample_estimate(c.wrong, unsure)},
                    {"worst", sample_estimate(2.0 * c.wrong - 0.001, 2.5 * unsure)},
                    {"worst_region", "luminance stratum 3 of 16"},
                    {"detectable", 2.3 * unsure},
                    {"reason", "made up"}};
    json["noise"] = scaled_estimate(c.noise, 1.6 * spread);
    json["bias_squared"] = sample_estimate(1.4 * c.wrong * c.wrong, 0.1 * c.wrong * c.wrong + 2e-6);
    json["relmse_1s"] = scaled_estimate(c.noise * c.sample, 2.0 * spread);
    json["efficiency"] = scaled_estimate(1.0 / (c.noise * c.sample), 2.0 * spread);
    json["time_to_equal_noise"] = is_base ? Json(nullptr) : scaled_estimate(ratio, 2.0 * spread);
    json["speed"] = is_base ? Json(nullptr) : scaled_estimate(base.sample / c.sample, spread);
    json["memory"] = scaled_estimate(38.0e6 + 4.0e8 * c.build, 0.01);
    json["front"] = is_base;
    json["skewed"] = c.verdict == "undecided";
    json["picture"] = sample_picture(c.noise, samples, 1.0 + c.wrong);
    json["picture_seconds"] = samples * c.sample;
    json["picture_samples"] = samples;
    return json;
}

inline double error_after(const Json& c, double seconds)
{
    const double left = seconds - c["build"]["wall"]["value"].get<double>();
    const double noise = c["noise"]["value"].get<double>() * c["render"]["wall"]["value"].get<double>();
    return left <= 0.0 ? HUGE_VAL
                       : noise / left + std::max(0.0, c["bias_squared"]["value"].get<double>());
}

/// Adds "front", and to each configuration whether it is on it.
inline void add_front(Json& results)
{
    Json front = Json::array();
    for (double t = 0.01; t < 100.0; t *= 1.02) {
        const Json* best = nullptr;
        for (const Json& c : results["configurations"])
            if (c["problem"].is_null() && (best == nullptr || error_after(c, t) < error_after(*best, t)))
                best = &c;
        if (best == nullptr || error_after(*best, t) == HUGE_VAL) continue;
        if (front.empty() || front.back()["configuration"] != (*best)["name"])
            front.push_back({{"configuration", (*best)["name"]}, {"from", t}, {"to", t}});
        front.back()["to"] = t * 1.02;
    }
    for (Json& c : results["configurations"])
        if (c["problem"].is_null())
            c["front"] = std::any_of(front.begin(), front.end(),
                                     [&](const Json& f) { return f["configuration"] == c["name"]; });
    results["front"] = front;
}

/// Replaces the values of a knob, texts, by what the page reads. A value of no configuration is the
/// base's.
inline void describe_values(Json& knob, const Json& configurations)
{
    knob["reference"] = "base";
    for (Json& value : knob["values"]) {
        const Json* found = &configurations[0];
        for (const Json& c : configurations)
            if (c["knob"] == knob["name"] && c["value"] == value) found = &c;
        value = {{"value", value},
                 {"configuration", (*found)["name"]},
                 {"time_to_equal_noise", found->value("time_to_equal_noise", Json(nullptr))}};
    }
}

inline std::vector<SampleConfiguration> sample_configurations()
{
    return {{"", ""},
            {"max-edges", "2", 0.002, 0.21e-3, 0.11, -0.42, "biased"},
            {"max-edges", "3", 0.002, 0.42e-3, 0.34, -0.17, "biased"},
            {"max-edges", "6", 0.002, 0.83e-3, 0.74, -0.021, "biased"},
            {"strategies", "path", 0.002, 0.38e-3, 3.9, -0.018, "undecided"},
            {"strategies", "light", 0.002, 0.33e-3, 6.2, -0.31, "biased"},
            {"strategies", "no inner", 0.002, 0.71e-3, 1.02},
            {"strategies", "no light image", 0.002, 0.9e-3, 1.9, 0.006, "undecided"},
            {"heuristic", "power", 0.002, 1.01e-3, 0.74},
            {"heuristic", "uniform", 0.002, 0.97e-3, 1.9},
            {"roulette", "0.5", 0.002, 0.62e-3, 1.35},
            {"roulette", "0.8", 0.002, 0.8e-3, 0.93},
            {"tree", "lbvh63", 0.0026, 0.99e-3, 0.8},
            {"tree", "sah", 0.035, 0.86e-3, 0.8},
            {"tree", "none", 0.0001, 3.4e-3, 0.8},
            {"device", "host", 0.31, 0.19e-3, 0.8},
            {"device", "host deterministic", 0.31, 0.22e-3, 0.8},
            {"device", "cuda", 0, 0, 0, 0, "", "there is no GPU"},
            {"batch", "1", 0.002, 1.2e-3, 0.8},
            {"batch", "16", 0.002, 0.98e-3, 0.8}};
}

/// 20 configurations, among them biased, undecided and failed ones.
inline Json sample_results()
{
    Json results = {
        {"format", "plumbline trade 1"},
        {"program", "0.9.0"},
        {"command",
         "plumbline trade scenes/cornell_glass.dae --seconds 60 --size 64x64 -o out/trade.html"},
        {"date", "2026-11-27"},
        {"machine", {{"processor", "AMD EPYC 9R14"}, {"threads", 2}}},
        {"scene", {{"name", "cornell_glass"}, {"hash", "6c1fd94ab31e8f02"}}},
        {"width", 64},
        {"height", 64},
        {"seconds", 60},
        {"rounds", 8},
        {"seed", 1},
        {"complete", true},
        {"confidence", 0.95},
        {"truth",
         {{"source", "golden/renders/cornell_glass.exr, made by the reference with bdpt"},
          {"samples", 8192},
          {"relmse", 1.1e-5},
          {"whole_error", 0.0004}}},
        {"noise_of_machine",
         {{"half_width", 0.04},
          {"stated", 0.1},
          {"sentence", "Half of all times are known within 4%, as asked for (10%)."}}},
        {"requirements",
         {{{"what", "strategies"},
           {"has", "emission hit, next event, inner connection"},
           {"left_out", "light image: no light reaches the pinhole but through glass"},
           {"gain", scaled_estimate(1.21, 0.03)},
           {"sentence", "Without the light image the same error takes 1/1.21 of the time."}},
          {{"what", "surfaces"},
           {"has", "diffuse, mirror, glass"},
           {"left_out", "nothing"},
           {"gain", nullptr},
           {"sentence", "Nothing can be left out."}}}},
        {"knobs",
         {{{"name", "max-edges"},
           {"what", "the longest paths that are formed"},
           {"values", {"2", "3", "6", "unlimited"}},
           {"sentence", "Short paths are fast and wrong: with 3 edges the picture is 17% too dark."}},
          {{"name", "strategies"},
           {"what", "how paths are formed"},
           {"values", {"all", "path", "light", "no inner", "no light image"}},
           {"sentence", "All strategies together need the least time."}},
          {{"name", "heuristic"},
           {"what", "the weights of strategies"},
           {"values", {"balance", "power", "uniform"}},
           {"sentence", "The power heuristic saves 7% of the time."}},
          {{"name", "roulette"},
           {"what", "the probability of going on after the third edge"},
           {"values", {"off", "0.5", "0.8"}},
           {"sentence", "No difference beyond the intervals."}},
          {{"name", "tree"},
           {"what", "the tree over the primitives"},
           {"values", {"lbvh30", "lbvh63", "sah", "none"}},
           {"sentence", "A tree by surface areas pays after 0.24 s."}},
          {{"name", "device"},
           {"what", "reference, or the fast path"},
           {"values", {"ref", "host", "host deterministic", "cuda"}},
           {"sentence", "The fast path takes a fifth of the time."}},
          {{"name", "batch"},
           {"what", "samples per batch"},
           {"values", {"1", "4", "16"}},
           {"sentence", "Batches of one sample cost 20%."}}}},
        {"configurations", Json::array()}};
    const std::vector<SampleConfiguration> all = sample_configurations();
    for (const SampleConfiguration& c : all)
        results["configurations"].push_back(json_of(c, all.front(), 0.1));
    for (Json& knob : results["knobs"]) describe_values(knob, results["configurations"]);
    add_front(results);
    return results;
}

} // namespace trade_test
