#include "images/parts.h"

#include "images/image_error.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace images {

namespace fs = std::filesystem;

namespace {

/// "batch 3 is", "batches 4..8 are"
std::string batches_are(const BatchRange& range)
{
    return range.size() == 1 ? "batch " + std::to_string(range.first) + " is"
                             : "batches " + describe(range) + " are";
}

} // namespace

Part read_part(const fs::path& path)
{
    Part part{path, read_exr_summary(path), {}};
    if (!part.says.range) throw ImageError(path, part.says.no_state);
    part.range = *part.says.range;
    if (part.range.size() == 0) throw ImageError(path, "holds no batch");
    return part;
}

Metadata without_counts(Metadata metadata)
{
    for (const char* key :
         {"samples", "dropped", "interrupted", "golden.reference_batches", "golden.functionals"})
        metadata.erase(key);
    return metadata;
}

void expect_same_render(const Part& first, const Part& other)
{
    const auto differ = [&](const std::string& name, const std::string& here, const std::string& there) {
        const std::string difference =
            here.empty() ? "it does not say its " + name + ", '" + there + "' in the other"
                         : "its " + name + " is '" + here + "', not " +
                               (there.empty() ? "said in the other" : "'" + there + "'");
        throw ImageError(other.path, "is no part of the same render as " +
                                         first.path.filename().string() + ": " + difference);
    };
    const auto size = [](const Part& part) {
        return std::to_string(part.says.width) + "x" + std::to_string(part.says.height);
    };
    if (size(first) != size(other)) differ("size", size(other), size(first));
    const Metadata there = without_counts(first.says.metadata);
    const Metadata here = without_counts(other.says.metadata);
    Metadata all = there;
    all.insert(here.begin(), here.end());
    for (const auto& [key, unused] : all)
        if (value_of(here, key) != value_of(there, key))
            differ(key, value_of(here, key), value_of(there, key));
}

std::vector<Part> in_order(std::vector<Part> parts, std::optional<std::uint64_t> batches)
{
    if (parts.empty()) throw std::invalid_argument("there is no part");
    for (const Part& part : parts) expect_same_render(parts.front(), part);
    std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.range.first; });

    const Part* before = nullptr; // whose batches reach farthest
    std::uint64_t end = batches ? 0 : parts.front().range.first;
    for (const Part& part : parts) {
        if (part.range.first < end)
            throw ImageError(part.path, batches_are({part.range.first, std::min(end, part.range.end)}) +
                                            " also in " + before->path.filename().string());
        if (part.range.first > end)
            throw ImageError(part.path, batches_are({end, part.range.first}) + " missing before it");
        before = &part;
        end = part.range.end;
    }
    if (batches && end < *batches)
        throw ImageError(before->path, batches_are({end, *batches}) + " missing after it");
    if (batches && end > *batches)
        throw ImageError(before->path, batches_are({*batches, end}) +
                                           " beyond the end of the whole, batch " +
                                           std::to_string(*batches - 1));
    return parts;
}

} // namespace images
