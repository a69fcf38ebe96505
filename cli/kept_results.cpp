#include "cli/kept_results.h"

#include "images/atomic_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace cli {

namespace {

void read_from(const std::string& option, const std::string& file,
               const std::function<void(const nlohmann::ordered_json&)>& use)
{
    try {
        const auto json = nlohmann::ordered_json::parse(images::read_file(file), nullptr, false);
        if (json.is_discarded()) throw std::invalid_argument("it is no JSON");
        use(json);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(option + " " + file + ": " + error.what());
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(option + " " + file +
                                    ": it is no result of this program: " + error.what());
    }
}

} // namespace

void resume_from(const std::string& output,
                 const std::function<void(const nlohmann::ordered_json&)>& restore)
{
    if (std::filesystem::exists(output)) read_from("--resume", output, restore);
}

void show_from(const std::string& file, const std::function<void(const nlohmann::ordered_json&)>& show)
{
    read_from("--from", file, show);
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
