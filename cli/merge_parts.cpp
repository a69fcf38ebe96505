#include "cli/merge_parts.h"

#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "golden/golden.h"
#include "images/file_ending.h"
#include "images/image_error.h"
#include "images/parts.h"
#include "images/whole_number.h"
#include "images/write_image.h"

#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cli {

namespace {

std::uint64_t number_of(const images::Part& part, const std::string& key)
{
    const std::string text = value_of(part.says.metadata, key);
    const auto number = images::whole_number(text);
    if (!number || *number == 0)
        throw images::ImageError(part.path, "its " + key + " is '" + text + "', not a number");
    return *number;
}

std::uint64_t batch_size_of(const images::Part& part)
{
    const std::uint64_t size = number_of(part, "batch_size");
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw images::ImageError(part.path, "its batch_size is absurd: " + std::to_string(size));
    return size;
}

/// Names the file in the errors of its contents.
void with_name_of(const images::Part& part, const std::function<void()>& join)
{
    try {
        join();
    } catch (const std::invalid_argument& error) {
        throw images::ImageError(part.path, error.what());
    }
}

/// The whole so far: the film with all that depends on the batches.
class Whole {
public:
    explicit Whole(const images::Part& first)
        : metadata_(images::without_counts(first.says.metadata)), batch_size_(batch_size_of(first))
    {}

    void add(const images::Part& part)
    {
        images::ExrPicture picture = images::read_exr(part.path);
        if (!picture.film) throw images::ImageError(part.path, picture.no_state);
        if (part.says.metadata.contains("dropped")) dropped_ += number_of(part, "dropped");
        if (metadata_.contains("strategies") && !picture.strategies) // no light in it
            picture.strategies.emplace(
                part.range, std::vector<images::StrategyBlock>(largest_blocks(part.range).size()));
        if (!film_) {
            film_ = std::move(picture.film);
            strategies_ = std::move(picture.strategies);
        } else {
            film_->append(std::move(*picture.film));
            if (strategies_) strategies_->append(std::move(*picture.strategies));
        }
        for (auto& [name, layer] : picture.layers)
            if (name.starts_with("batch.")) batches_.insert_or_assign(name, std::move(layer));
    }

    void write(const MergeCommand& options) const
    {
        images::Metadata metadata = metadata_;
        metadata["samples"] = std::to_string(film_->batches() * batch_size_);
        if (dropped_ > 0) metadata["dropped"] = std::to_string(dropped_);
        const auto state = options.finish ? images::FilmState::omit : images::FilmState::keep;
        for (const std::string& path : options.outputs)
            if (!images::has_ending(path, ".exr"))
                images::write_image(path, *film_, metadata, options.exposure);
            else if (!strategies_)
                images::write_exr(path, *film_, metadata, batches_, state);
            else
                images::write_exr(
                    path, *film_, metadata,
                    images::layers_of(strategies_->means(static_cast<std::uint32_t>(batch_size_))),
                    state, {}, *strategies_);
    }

private:
    images::Metadata metadata_;
    std::uint64_t batch_size_;
    std::uint64_t dropped_ = 0;
    std::optional<images::Film> film_;
    std::optional<images::StrategySums> strategies_;
    images::Layers batches_; // those that render --keep-batches keeps
};

/// The same for a golden.
class WholeGolden {
public:
    explicit WholeGolden(const images::Part& first)
        : metadata_(images::without_counts(first.says.metadata)), batch_size_(batch_size_of(first))
    {}

    void add(const images::Part& part)
    {
        golden::GoldenMaker next = golden::GoldenMaker::resume(part.path);
        if (!maker_)
            maker_.emplace(std::move(next));
        else
            maker_->append(std::move(next));
    }

    void write(const MergeCommand& options)
    {
        metadata_["samples"] = std::to_string(maker_->film().batches() * batch_size_);
        for (const std::string& path : options.outputs)
            maker_->write(path, metadata_,
                          options.finish ? images::FilmState::omit : images::FilmState::keep);
    }

private:
    images::Metadata metadata_;
    std::uint64_t batch_size_;
    std::optional<golden::GoldenMaker> maker_;
};

template <class Whole>
ExitStatus join(Whole whole, const std::vector<images::Part>& parts, const MergeCommand& options)
{
    Progress progress("merge", 0.0, static_cast<double>(parts.size()), options.quiet);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (interrupt_requested()) throw Interrupted();
        with_name_of(parts[i], [&] { whole.add(parts[i]); });
        progress.update(static_cast<double>(i + 1));
    }
    with_name_of(parts.front(), [&] { whole.write(options); });
    return fine;
}

} // namespace

ExitStatus merge_parts(const MergeCommand& options)
{
    catch_interrupts();
    std::vector<images::Part> parts;
    for (const std::string& file : options.parts) {
        if (interrupt_requested()) throw Interrupted();
        parts.push_back(images::read_part(file));
    }
    std::optional<std::uint64_t> batches;
    if (options.samples > 0) {
        const std::uint64_t size = batch_size_of(parts.front());
        if (options.samples % size != 0)
            throw std::invalid_argument("-s " + std::to_string(options.samples) +
                                        ": not a multiple of the " + std::to_string(size) +
                                        " samples of a batch");
        batches = options.samples / size;
    }
    parts = in_order(std::move(parts), batches);
    if (!parts.front().says.metadata.contains("golden.pilot_batches"))
        return join(Whole(parts.front()), parts, options);
    for (const std::string& path : options.outputs)
        if (!images::has_ending(path, ".exr"))
            throw std::invalid_argument("-o " + path + ": a golden is an .exr");
    return join(WholeGolden(parts.front()), parts, options);
}

} // namespace cli
