#include "check/mistakes/part_pictures.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>

namespace check {

namespace {

bool has_light(const ref::Rgb& light)
{
    return std::isfinite(light.r + light.g + light.b);
}

} // namespace

PartPictures::PartPictures(const ref::World& world, const ref::PathOptions& options,
                           const std::vector<PathFactor>& parts, std::uint32_t samples_per_batch,
                           unsigned threads)
    : world_(world), options_(options), parts_(parts), samples_(samples_per_batch), threads_(threads),
      films_(parts.size(), images::Film(world.camera.width(), world.camera.height()))
{}

std::vector<images::Image> PartPictures::batch(std::uint64_t number,
                                               const images::Monitor& monitor) const
{
    const int width = world_.camera.width();
    const int height = world_.camera.height();
    std::vector<images::Image> sums(parts_.size(), images::Image(width, height));
    const UsePath use = [&](const FinishedPath& path, std::uint32_t pixel, const ref::Rgb& light) {
        if (!has_light(light)) return; // the reference leaves such contributions out as well
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const double factor = parts_[i](path);
            if (factor != 0.0) sums[i].pixels[pixel] += factor / samples_ * light;
        }
    };
    for (std::uint32_t pixel = 0; pixel < static_cast<std::uint32_t>(width * height); ++pixel) {
        if (monitor.stop && monitor.stop()) return {};
        for (std::uint32_t i = 0; i < samples_; ++i)
            for_each_path(world_, options_,
                          {options_.seed, pixel, static_cast<std::uint32_t>(number * samples_ + i)},
                          use);
    }
    return sums;
}

bool PartPictures::render(std::uint64_t batches, const images::Monitor& monitor)
{
    for (std::uint64_t first = films_.front().batches(); first < batches;) {
        const std::uint64_t end = std::min(batches, first + threads_);
        std::vector<std::vector<images::Image>> round(end - first);
        std::vector<std::exception_ptr> errors(round.size());
        {
            std::vector<std::jthread> workers;
            for (std::size_t i = 0; i < round.size(); ++i)
                workers.emplace_back([&, i] {
                    try {
                        round[i] = batch(first + i, monitor);
                    } catch (...) {
                        errors[i] = std::current_exception();
                    }
                });
        }
        for (const std::exception_ptr& error : errors)
            if (error) std::rethrow_exception(error);
        for (const auto& made : round) {
            if (made.empty()) return false;
            for (std::size_t part = 0; part < made.size(); ++part) films_[part].add_batch(made[part]);
        }
        first = end;
        if (monitor.progress) monitor.progress(static_cast<double>(first));
    }
    return true;
}

} // namespace check
