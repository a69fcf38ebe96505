#include "check/renderers/render_picture.h"

#include "check/child_program.h"
#include "images/exr.h"
#include "images/file_ending.h"
#include "images/image_error.h"
#include "images/non_finite.h"
#include "images/pfm.h"

#include <string_view>

namespace check {

namespace fs = std::filesystem;

namespace {

/// Without control characters, which could move a terminal's cursor; a carriage return, by which
/// progress is overwritten, begins a line.
std::string readable(const std::string& output)
{
    std::string text;
    for (const char c : output) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\r' && (text.empty() || text.back() != '\n')) text += '\n';
        if (c == '\n' || c == '\t' || (byte >= 0x20 && byte != 0x7f)) text += c;
    }
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

std::string say_size(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

} // namespace

std::vector<std::string> words_for(const std::vector<std::string>& command, const PictureTask& task)
{
    return filled_in(command, {{"scene", task.scene.string()},
                               {"width", std::to_string(task.width)},
                               {"height", std::to_string(task.height)},
                               {"samples", std::to_string(task.samples)},
                               {"seed", std::to_string(task.seed)},
                               {"max_edges", task.max_edges},
                               {"out", task.out.string()}});
}

images::Image read_candidate(const fs::path& path, int width, int height)
{
    images::Image picture =
        images::has_ending(path, ".pfm") ? images::read_pfm(path) : images::read_exr(path).mean;
    if (picture.width != width || picture.height != height)
        throw images::ImageError(path, "has " + say_size(picture.width, picture.height) +
                                           " pixels instead of " + say_size(width, height));
    if (const auto fault = images::say_non_finite(picture)) throw images::ImageError(path, *fault);
    return picture;
}

PictureAttempt render_picture(const std::vector<std::string>& command, const PictureTask& task,
                              double limit, const std::function<bool()>& stop)
{
    fs::remove(task.out);
    bool stopped = false;
    const ChildEnd end = run_child(words_for(command, task), limit, [&] {
        stopped = stopped || stop();
        return stopped;
    });
    PictureAttempt attempt;
    attempt.seconds = end.seconds;
    attempt.last_lines = readable(end.last_lines);
    if (stopped && end.how == ChildEnd::How::timed_out) return attempt;
    if (end.how != ChildEnd::How::exited || end.code != 0) {
        attempt.failure = describe(end);
        return attempt;
    }
    if (!fs::exists(task.out)) {
        attempt.failure = "exit status 0, but it wrote no picture";
        return attempt;
    }
    try {
        attempt.picture = read_candidate(task.out, task.width, task.height);
    } catch (const images::ImageError& error) {
        // "FILE: what is wrong": the file's name means nothing to the reader.
        const std::string text = error.what();
        const std::string name = task.out.string() + ": ";
        attempt.failure = "its picture: " + (text.starts_with(name) ? text.substr(name.size()) : text);
    }
    return attempt;
}

} // namespace check
