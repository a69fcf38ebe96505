// The program: chooses the subcommand, and turns every error into one line and an exit status.

#include "cli/bvh_command.h"
#include "cli/check_builder_command.h"
#include "cli/check_renderer_command.h"
#include "cli/check_tree_command.h"
#include "cli/command.h"
#include "cli/compare_command.h"
#include "cli/counts.h"
#include "cli/explain_command.h"
#include "cli/explain_tree_command.h"
#include "cli/export_command.h"
#include "cli/extremes_command.h"
#include "cli/golden_command.h"
#include "cli/interrupt.h"
#include "cli/merge_command.h"
#include "cli/render_command.h"
#include "cli/standard_output.h"
#include "cli/trade_command.h"
#include "cli/words_after_dashes.h"
#include "cuda/launch/device.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <exception>
#include <iostream>
#include <new>

namespace {

/// Prints one line: further lines of CLI11's messages only describe --help.
int complain(std::string_view message)
{
    std::cerr << "plumbline: " << message.substr(0, message.find('\n')) << '\n';
    return cli::bad_input;
}

/// The help that lists the options of the subcommand that was chosen.
std::string where_help_is(const CLI::App& program)
{
    const auto chosen = program.get_subcommands();
    const std::string command = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    return " (plumbline " + command + "--help lists the options)";
}

/// Reads the command line and does the work. The exit status.
int run(CLI::App& program, const cli::Work& work, int argc, char** argv)
{
    try {
        program.parse(argc, argv);
        return work();
    } catch (const CLI::Success& help) {
        return program.exit(help);
    } catch (const CLI::RequiredError& error) {
        // CLI11's message does not contain the unknown word.
        const std::string_view word = argc > 1 ? argv[1] : "-";
        if (program.get_subcommands().size() == 1)
            return complain(error.what() + where_help_is(program));
        if (word.starts_with('-')) return complain(error.what());
        return complain(std::string(word) + ": no such command (plumbline --help lists them)");
    } catch (const CLI::ParseError& error) {
        return complain(error.what() + where_help_is(program));
    } catch (const cli::Interrupted&) {
        complain("interrupted");
        return cli::interrupted;
    } catch (const std::bad_alloc&) {
        return complain("out of memory");
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}

} // namespace

int main(int argc, char** argv)
{
    // A file that exceeds a limit is then an error of the write, which is reported.
    std::signal(SIGXFSZ, SIG_IGN);
    cli::expect_closed_pipes();
    CLI::App program("Plumbline: a reference for tree builders and bidirectional path tracers",
                     "plumbline");
    program.set_version_flag(
        "--version", [] { return "plumbline " PLUMBLINE_VERSION "\nGPU: " + fast::describe_device(); });
    program.require_subcommand(1);
    program.footer(
        "Exit status: 0 success, 1 a check failed, 2 bad input, 3 inconclusive, 130 interrupted.");
    cli::Work work;
    cli::add_render_command(program, work);
    cli::add_merge_command(program, work);
    cli::add_bvh_command(program, work);
    cli::add_golden_command(program, work);
    cli::add_compare_command(program, work);
    cli::add_check_renderer_command(program, work);
    cli::add_trade_command(program, work);
    cli::add_extremes_command(program, work);
    cli::add_check_tree_command(program, work);
    cli::add_check_builder_command(program, work);
    cli::add_explain_command(program, work);
    cli::add_explain_tree_command(program, work);
    cli::add_export_command(program, work);
    cli::take_exponents(program);
    for (const char* name : {"check-renderer", "check-builder"})
        cli::take_words_after_dashes(argc, argv, name);

    const int status = run(program, work, argc, argv);
    if (cli::flush_standard_output()) return status;
    complain("standard output cannot be written");
    return status == cli::fine ? cli::bad_input
                               : status; // keep the status of a verdict or an interruption
}
