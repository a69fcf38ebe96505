#include "cli/kept_results.h"

#include "images/atomic_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace cli {

void resume_from(const std::string& output,
                 const std::function<void(const nlohmann::ordered_json&)>& restore)
{
    if (!std::filesystem::exists(output)) return;
    try {
        const auto json = nlohmann::ordered_json::parse(images::read_file(output), nullptr, false);
        if (json.is_discarded()) throw std::invalid_argument("it is no JSON");
        restore(json);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("--resume " + output + ": " + error.what());
    }
}

ExitStatus say_interrupted(const std::string& output)
{
    std::cerr << "plumbline: interrupted: "
              << (output.empty() ? "with -o, --resume would go on from here"
                                 : "--resume goes on from here")
              << '\n';
    return interrupted;
}

} // namespace cli
