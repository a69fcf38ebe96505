#include "images/parts.h"

#include "images/image_error.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace images {

namespace fs = std::filesystem;

namespace {

std::string batches_text(const BatchRange& range)
{
    return range.size() == 1 ? "batch " + std::to_string(range.first) : "batches " + describe(range);
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
        const auto said = [](const std::string& text) { return text.empty() ? "not said" : "'" + text + "'"; };
        throw ImageError(other.path, "is no part of the same render as " + first.path.filename().string() +
                                         ": its " + name + " is " + said(here) + ", not " + said(there));
    };
    const auto size = [](const Part& part) {
        return std::to_string(part.says.width) + "x" + std::to_string(part.says.height);
    };
    if (size(first) != size(other)) differ("size", size(other), size(first));
    const Metadata there = without_counts(first.says.metadata);
    const Metadata here = without_counts(other.says.metadata);
    const auto value = [](const Metadata& metadata, const std::string& key) {
        const auto found = metadata.find(key);
        return found == metadata.end() ? "" : found->second;
    };
    Metadata all = there;
    all.insert(here.begin(), here.end());
    for (const auto& [key, unused] : all)
        if (value(here, key) != value(there, key)) differ(key, value(here, key), value(there, key));
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
            throw ImageError(part.path,
                             batches_text({part.range.first, std::min(end, part.range.end)}) +
                                 (part.range.size() == 1 ? " is" : " are") + " also in " +
                                 before->path.filename().string());
        if (part.range.first > end)
            throw ImageError(part.path, batches_text({end, part.range.first}) + " before it " +
                                            (part.range.first - end == 1 ? "is" : "are") + " missing");
        before = &part;
        end = part.range.end;
    }
    if (batches && end < *batches)
        throw ImageError(before->path, batches_text({end, *batches}) + " after it " +
                                           (*batches - end == 1 ? "is" : "are") + " missing");
    if (batches && end > *batches)
        throw ImageError(before->path, "holds " + batches_text({*batches, end}) +
                                           ", which the whole has not: it ends with batch " +
                                           std::to_string(*batches - 1));
    return parts;
}

} // namespace images
