#include "golden/golden.h"

#include "golden/rounded.h"
#include "images/image_error.h"
#include "images/non_finite.h"
#include "images/whole_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace golden {

namespace fs = std::filesystem;

namespace {

constexpr const char* pilot_mean_layer = "pilot.mean";
constexpr const char* pilot_noise_layer = "pilot.noise";
constexpr const char* pilot_batches_key = "golden.pilot_batches";
constexpr const char* reference_batches_key = "golden.reference_batches";
constexpr const char* functionals_key = "golden.functionals";

images::Image in_single_precision(images::Image image)
{
    for (images::Rgb& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<double>(to_float(pixel[channel]));
    return image;
}

std::string reference_layer(std::size_t index)
{
    std::string digits = std::to_string(index);
    if (digits.size() < 3) digits.insert(0, 3 - digits.size(), '0');
    return "reference." + digits;
}

/// The rows as pictures of the golden's size.
void add_rows(images::Layers& layers, const std::vector<Row>& rows, const Functionals& functionals)
{
    const std::size_t count = functionals.size();
    const auto pixels = functionals.pilot().mean.pixels.size();
    for (std::size_t at = 0; at < rows.size() * count; ++at) {
        images::Image& layer = layers[reference_layer(at / pixels)];
        if (layer.pixels.empty()) layer = images::Image(functionals.width(), functionals.height());
        for (std::size_t c = 0; c < channel_count; ++c)
            layer.pixels[at % pixels][static_cast<int>(c)] =
                static_cast<double>(rows[at / count][c * count + at % count]);
    }
}

/// `batches`: of the reference. `more`: rows behind theirs, one for the slopes.
std::vector<Row> read_rows(const fs::path& path, const images::Layers& layers,
                           const Functionals& functionals, std::uint64_t batches, std::uint64_t more)
{
    const std::size_t count = functionals.size();
    const auto pixels = functionals.pilot().mean.pixels.size();
    // Checked before memory is allocated: the layers must hold that many.
    const std::uint64_t most = layers.size() * pixels / count;
    const std::size_t layers_needed = ((batches + more) * count + pixels - 1) / pixels;
    if (batches > most || batches + more > most || !layers.contains(reference_layer(layers_needed - 1)))
        throw images::ImageError(path, "damaged golden: says it holds " + std::to_string(batches) +
                                           " reference batches, and does not");
    std::vector<Row> rows(batches + more, Row(channel_count * count));
    for (std::size_t at = 0; at < rows.size() * count; ++at) {
        const auto layer = layers.find(reference_layer(at / pixels));
        if (layer == layers.end())
            throw images::ImageError(path,
                                     "damaged golden: has no layer " + reference_layer(at / pixels));
        for (std::size_t c = 0; c < channel_count; ++c) {
            const double value = layer->second.pixels[at % pixels][static_cast<int>(c)];
            if (!std::isfinite(value))
                throw images::ImageError(path, "damaged golden: a reference value is NaN or infinite");
            rows[at / count][c * count + at % count] = static_cast<float>(value);
        }
    }
    return rows;
}

const std::string& find_text(const fs::path& path, const images::Metadata& metadata, const char* key)
{
    const auto found = metadata.find(key);
    if (found == metadata.end())
        throw images::ImageError(path, "not a golden: says nothing of its " + std::string(key));
    return found->second;
}

std::uint64_t find_number(const fs::path& path, const images::Metadata& metadata, const char* key)
{
    const std::string& text = find_text(path, metadata, key);
    const auto number = images::whole_number(text);
    constexpr std::uint64_t largest = std::uint64_t{1} << 32;
    if (!number || *number > largest) throw images::ImageError(path, "'" + text + "' is no " + key);
    return *number;
}

/// The layout of the functionals. Two builds of this program read each other's goldens if it is equal.
std::string say_functionals(const Functionals& functionals)
{
    return "version 1, " + std::to_string(functionals.size()) + " per channel";
}

Functionals read_functionals(const fs::path& path, const images::ExrPicture& picture)
{
    const auto mean = picture.layers.find(pilot_mean_layer);
    const auto noise = picture.layers.find(pilot_noise_layer);
    if (mean == picture.layers.end() || noise == picture.layers.end())
        throw images::ImageError(path, "not a golden: has no pilot");
    const std::uint64_t batches = find_number(path, picture.metadata, pilot_batches_key);
    const std::string& said = find_text(path, picture.metadata, functionals_key);
    try {
        Functionals functionals({mean->second, noise->second, batches});
        if (said != say_functionals(functionals))
            throw images::ImageError(path, "its functionals are '" + said + "', this program's '" +
                                               say_functionals(functionals) + "': make it again");
        return functionals;
    } catch (const std::invalid_argument& error) {
        throw images::ImageError(path, std::string("damaged golden: ") + error.what());
    }
}

} // namespace

double batch_size_of(const Golden& golden)
{
    const auto found = golden.metadata.find("batch_size");
    double number = 0.0;
    if (found != golden.metadata.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
    return number > 0.0 ? number : 0.0;
}

Golden read_golden(const fs::path& path)
{
    images::ExrPicture picture = images::read_exr(path);
    Functionals functionals = read_functionals(path, picture);
    if (picture.film && picture.film->range().first > 0)
        throw images::ImageError(path, "a part of a golden: plumbline merge joins parts");
    if (!picture.standard_error) throw images::ImageError(path, "not a golden: has no standard error");
    const std::uint64_t batches = find_number(path, picture.metadata, reference_batches_key);
    if (batches < 1) throw images::ImageError(path, "not a finished golden: no batch after its pilot");
    std::vector<Row> rows = read_rows(path, picture.layers, functionals, batches, 1);
    Row slopes = std::move(rows.back());
    rows.pop_back();
    return {std::move(picture.mean),
            std::move(*picture.standard_error),
            std::move(picture.metadata),
            std::move(functionals),
            std::move(rows),
            std::move(slopes)};
}

GoldenMaker::GoldenMaker(int width, int height, std::uint64_t pilot_batches, std::uint64_t first)
    : film_(width, height, first), pilot_batches_(pilot_batches)
{
    if (pilot_batches < 2) throw std::invalid_argument("a pilot needs two batches at least");
    if (first >= pilot_batches)
        throw std::invalid_argument("batches after the pilot need the complete pilot");
}

GoldenMaker::GoldenMaker(const Functionals& functionals, std::uint64_t first)
    : film_(functionals.width(), functionals.height(), first),
      pilot_batches_(functionals.pilot().batches), functionals_(functionals)
{
    if (first < pilot_batches_)
        throw std::invalid_argument("batch " + std::to_string(first) + " belongs to the pilot");
}

GoldenMaker GoldenMaker::resume(const fs::path& path)
{
    images::ExrPicture picture = images::read_exr(path);
    if (!picture.film) throw images::ImageError(path, picture.no_state);
    const std::uint64_t pilot_batches = find_number(path, picture.metadata, pilot_batches_key);
    if (pilot_batches < 2)
        throw images::ImageError(path, "damaged golden: a pilot of fewer than two batches");
    GoldenMaker maker(picture.film->width(), picture.film->height(), pilot_batches);
    maker.film_ = std::move(*picture.film);
    const images::BatchRange& range = maker.film_.range();
    if (range.end < pilot_batches || (range.first > 0 && range.first < pilot_batches)) return maker;
    maker.functionals_ = read_functionals(path, picture);
    const std::uint64_t first = std::max(range.first, pilot_batches);
    const std::uint64_t batches = range.end - first;
    if (batches != find_number(path, picture.metadata, reference_batches_key))
        throw images::ImageError(path, "damaged golden: its film and its reference differ in length");
    if (batches == 0) return maker;
    const bool has_slopes = first == pilot_batches;
    maker.reference_ = read_rows(path, picture.layers, *maker.functionals_, batches, has_slopes ? 1 : 0);
    if (!has_slopes) return maker;
    maker.slopes_ = std::move(maker.reference_.back());
    maker.reference_.pop_back();
    return maker;
}

/// The functionals need the pilot from its first batch on: a part that begins later ends with it.
void GoldenMaker::expect_room(std::uint64_t end) const
{
    if (film_.range().first > 0 && !functionals_ && end > pilot_batches_)
        throw std::invalid_argument("batches " + images::describe({film_.range().first, end}) +
                                    " cross the end of the pilot, batch " +
                                    std::to_string(pilot_batches_));
}

void GoldenMaker::complete_pilot()
{
    if (film_.range() == images::BatchRange{0, pilot_batches_}) functionals_.emplace(make_pilot(film_));
}

void GoldenMaker::add_batch(const images::Image& batch)
{
    const std::uint64_t number = film_.range().end;
    if (const auto fault = images::say_non_finite(batch))
        throw std::invalid_argument("batch " + std::to_string(number) + ": " + *fault);
    expect_room(number + 1);
    Row row;
    if (functionals_) row = functionals_->evaluate(batch);
    if (number == pilot_batches_) slopes_ = functionals_->slopes(batch);
    film_.add_batch(batch);
    if (functionals_) reference_.push_back(std::move(row));
    complete_pilot();
}

void GoldenMaker::append(GoldenMaker next)
{
    if (next.pilot_batches_ != pilot_batches_)
        throw std::invalid_argument("the pilots differ in length");
    expect_room(next.film_.range().end);
    if (functionals_ && next.functionals_ && !(functionals_->pilot() == next.functionals_->pilot()))
        throw std::invalid_argument("the parts are made with different pilots");
    film_.append(std::move(next.film_));
    if (reference_.empty()) slopes_ = std::move(next.slopes_);
    std::move(next.reference_.begin(), next.reference_.end(), std::back_inserter(reference_));
    complete_pilot();
}

void GoldenMaker::expect_golden() const
{
    if (film_.range().first > 0) throw std::invalid_argument("a golden needs all batches from 0 on");
    if (reference_.empty()) throw std::invalid_argument("a golden needs batches after its pilot");
}

Golden GoldenMaker::golden(const images::Metadata& metadata) const
{
    expect_golden();
    images::Metadata all = metadata;
    describe(all);
    images::BatchMoments moments = film_.moments();
    images::Image error = images::standard_error(moments, film_.batches());
    return {in_single_precision(std::move(moments.mean)),
            in_single_precision(std::move(error)),
            std::move(all),
            *functionals_,
            reference_,
            slopes_};
}

void GoldenMaker::describe(images::Metadata& metadata) const
{
    metadata[pilot_batches_key] = std::to_string(pilot_batches_);
    metadata[reference_batches_key] = std::to_string(reference_.size());
    if (functionals_) metadata[functionals_key] = say_functionals(*functionals_);
}

void GoldenMaker::write(const fs::path& path, const images::Metadata& metadata,
                        images::FilmState state) const
{
    if (state == images::FilmState::omit) expect_golden();
    images::Metadata all = metadata;
    describe(all);
    images::Layers layers;
    images::Layers half_layers;
    if (functionals_) {
        layers[pilot_mean_layer] = functionals_->pilot().mean;
        half_layers[pilot_noise_layer] = functionals_->pilot().noise;
        std::vector<Row> rows = reference_;
        if (!slopes_.empty()) rows.push_back(slopes_);
        add_rows(half_layers, rows, *functionals_);
    }
    images::write_exr(path, film_, all, layers, state, half_layers);
}

} // namespace golden
