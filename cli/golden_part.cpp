// A part of a golden. The functionals of its reference batches need the complete pilot, which is a part,
// too, or the merge of its parts.

#include "cli/golden_part.h"

#include "cli/golden_render.h"
#include "cli/output_files.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "golden/golden.h"
#include "images/image_error.h"
#include "images/parts.h"
#include "images/write_image.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace cli {

namespace fs = std::filesystem;

namespace {

images::BatchRange range_of_part(const GoldenCommand& options)
{
    const images::BatchRange range = parse_batches(options.batches, options.batch_size);
    const std::string text = "--batches " + options.batches + ": ";
    const std::uint64_t all = options.samples / options.batch_size;
    if (range.end > all)
        throw std::invalid_argument(text + "a golden of -s " + std::to_string(options.samples) +
                                    " ends with batch " + std::to_string(all - 1));
    const std::uint64_t pilot = options.pilot_batches;
    if (range.first < pilot && range.end > pilot)
        throw std::invalid_argument(
            text + "crosses the end of the pilot: a part ends at or begins with batch " +
            std::to_string(pilot));
    if (range.first >= pilot && options.pilot_file.empty())
        throw std::invalid_argument(text +
                                    "after the pilot: --pilot-file names the merge of the parts of 0.." +
                                    std::to_string(pilot));
    if (range.first < pilot && !options.pilot_file.empty())
        throw std::invalid_argument(text + "part of the pilot, which needs no --pilot-file");
    return range;
}

/// The beginning of the part, or what an earlier start has made of it.
golden::GoldenMaker starting_maker(const GoldenCommand& options, const images::BatchRange& range,
                                   const images::Part& wanted)
{
    if (fs::exists(options.output)) {
        const images::Part earlier = images::read_part(options.output);
        expect_same_render(wanted, earlier);
        if (earlier.range.first != range.first || earlier.range.end > range.end)
            throw images::ImageError(options.output, "holds batches " + describe(earlier.range) +
                                                         ", not " + options.batches);
        return golden::GoldenMaker::resume(options.output);
    }
    const Size size = parse_size(options.size);
    if (range.first < options.pilot_batches)
        return {size.width, size.height, options.pilot_batches, range.first};
    const images::Part pilot = images::read_part(options.pilot_file);
    expect_same_render(wanted, pilot);
    const auto maker = golden::GoldenMaker::resume(options.pilot_file);
    if (!maker.functionals())
        throw images::ImageError(options.pilot_file, "holds batches " + describe(pilot.range) +
                                                         ": the pilot is 0.." +
                                                         std::to_string(options.pilot_batches));
    return {*maker.functionals(), range.first};
}

} // namespace

ExitStatus make_golden_part(const GoldenCommand& options)
{
    if (options.scenes.size() != 1) throw std::invalid_argument("--batches: name one scene");
    const std::string& file = options.scenes.front();
    const images::BatchRange range = range_of_part(options);
    expect_ending(options.output, "-o", ".exr");
    expect_different_files({{"-o", options.output}},
                           {{"the scene", file}, {"--pilot-file", options.pilot_file}});
    images::check_writable(options.output);

    const Size size = parse_size(options.size);
    const RenderCommand command = render_of(options, file);
    const scenes::Scene scene = load_scene(file, false, options.quiet);
    images::Metadata metadata = describe(command, scene);
    metadata["command"] = golden_command_of(options, file);
    metadata["golden.pilot_batches"] = std::to_string(options.pilot_batches);
    const images::Part wanted{options.output, {size.width, size.height, metadata, {}, ""}, range};
    golden::GoldenMaker maker = starting_maker(options, range, wanted);

    const auto keep = [&] {
        metadata["samples"] = std::to_string(maker.film().batches() * options.batch_size);
        maker.write(options.output, metadata, images::FilmState::keep);
    };
    const auto renderer = renderer_for(command, scene);
    if (!fill_golden(maker, range.end, *renderer, {scene.name, options.quiet, keep, options.watch})) {
        std::cerr << "plumbline: interrupted: the same command goes on from here\n";
        return interrupted;
    }
    keep();
    return fine;
}

} // namespace cli
