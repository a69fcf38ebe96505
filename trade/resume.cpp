#include "trade/resume.h"

#include "images/base64.h"

#include <algorithm>
#include <stdexcept>

namespace trade {

namespace {

Json json_of(const golden::Moments& moments)
{
    return Json::array({moments.count, moments.mean, moments.variance, moments.skewness});
}

golden::Moments moments_from(const Json& json)
{
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>(),
            json.at(3).get<double>()};
}

Round round_from(const Json& json, std::size_t regions)
{
    Round round;
    const auto seconds = [&](const char* key) {
        return Seconds{json.at(key).at(0).get<double>(), json.at(key).at(1).get<double>()};
    };
    round.build = seconds("build");
    round.render = seconds("render");
    round.plan = {json.at("batch_size").get<std::uint32_t>(), json.at("batches").get<std::uint64_t>()};
    round.noise = moments_from(json.at("noise"));
    round.bias_squared = json.at("bias_squared").get<double>();
    for (const Json& moments : json.at("brightness")) round.brightness.push_back(moments_from(moments));
    if (round.brightness.size() != regions || round.plan.batches == 0 || round.plan.batch_size == 0)
        throw std::invalid_argument("a round is not complete");
    return round;
}

} // namespace

Json raw(const Round& round)
{
    Json json = {{"build", Json::array({round.build.wall, round.build.cpu})},
                 {"render", Json::array({round.render.wall, round.render.cpu})},
                 {"batch_size", round.plan.batch_size},
                 {"batches", round.plan.batches},
                 {"noise", json_of(round.noise)},
                 {"bias_squared", round.bias_squared},
                 {"brightness", Json::array()}};
    for (const golden::Moments& moments : round.brightness)
        json["brightness"].push_back(json_of(moments));
    return json;
}

Json identity(const Description& description, const StudyOptions& options, const Truth& truth)
{
    return {{"scene_hash", description.scene_hash},
            {"width", truth.mean().width},
            {"height", truth.mean().height},
            {"truth_error", truth.own_error()},
            {"seconds", options.seconds},
            {"rounds", options.rounds},
            {"seed", options.seed}};
}

std::vector<Measurements> restored(const Json& json, const Description& description,
                                   const StudyOptions& options,
                                   const std::vector<Configuration>& configurations, const Truth& truth)
{
    std::vector<Measurements> measured(configurations.size());
    try {
        if (json.at("format") != results_format)
            throw std::invalid_argument("its format is another one");
        const Json expected = identity(description, options, truth);
        for (const auto& [key, value] : expected.items())
            if (json.at("identity").at(key) != value)
                throw std::invalid_argument("its " + key + " is " + json.at("identity").at(key).dump() +
                                            ", and not " + value.dump());
        for (const Json& one : json.at("configurations")) {
            const auto found = std::ranges::find(configurations, one.at("name").get<std::string>(),
                                                 &Configuration::name);
            if (found == configurations.end() || one.at("plan").is_null()) continue;
            Measurements& into = measured[static_cast<std::size_t>(found - configurations.begin())];
            into.plan = Plan{one.at("plan").at(0).get<std::uint32_t>(),
                             one.at("plan").at(1).get<std::uint64_t>()};
            for (const Json& round : one.at("raw"))
                into.rounds.push_back(round_from(round, truth.regions().size()));
            into.peak_bytes = one.at("peak_bytes").get<std::vector<double>>();
            if (one.contains("picture"))
                into.picture = images::from_base64(one.at("picture").get<std::string>());
        }
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(std::string("it is no result of this program: ") + error.what());
    }
    return measured;
}

} // namespace trade
