#pragma once

// Somebody else's program as a child process: with a limit of time, and whatever way it ends.

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace check {

/// The words of a command in which each {name} is replaced by its value. Throws std::invalid_argument
/// for a {name} without a value; the message names it and lists those that there are. Other braces, such
/// as of awk's programs, stay as they are.
std::vector<std::string> filled_in(const std::vector<std::string>& words,
                                   const std::map<std::string, std::string>& values);

/// How a child process ended.
struct ChildEnd {
    enum class How { exited, signalled, timed_out } how;
    int code = 0;           // exit status, or the signal; 0 if its time was up
    double seconds = 0.0;   // from its start, by a clock on the wall
    std::string last_lines; // of its standard output and standard error together, 2000 bytes at most
};

/// "exit status 3", "killed by signal 11 (Segmentation fault)", "still running after 10 s".
std::string describe(const ChildEnd& end);

/// Runs the program words[0] with the arguments words[1...], without standard input. After
/// `limit_seconds` seconds, or when `stop` returns true (asked about fifty times a second), it is
/// killed, and so is every process that it has started in its process group; `stop` counts as a
/// time-out. Throws std::runtime_error if the program cannot be started, or after kill_children().
ChildEnd run_child(const std::vector<std::string>& words, double limit_seconds,
                   const std::function<bool()>& stop = {});

/// Kills all programs that run_child is running, with their process groups, and waits until they have
/// ended, for a second at most; no other is started then. For a program that is about to be ended
/// without its destructors. May be called from any thread.
void kill_children();

} // namespace check
