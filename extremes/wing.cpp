#include "extremes/wing.h"

#include "cuda/launch/device.h"

#include <algorithm>
#include <string_view>

namespace extremes {

namespace {

constexpr std::string_view host_name = "host";
constexpr std::string_view device_name = "cuda";

} // namespace

std::string name_of(Wing wing)
{
    if (wing == Wing::ref) return "ref";
    return std::string(wing == Wing::host ? host_name : device_name);
}

Format format_of(Wing wing)
{
    return wing == Wing::ref ? Format::binary64 : Format::binary32;
}

std::vector<Wing> wings()
{
    static const bool has_device = fast::find_device().usable;
    std::vector<Wing> found = {Wing::ref, Wing::host};
    if (has_device) found.push_back(Wing::cuda);
    return found;
}

std::string why_no_device(const std::string& method)
{
    const fast::Device device = fast::find_device();
    return method.starts_with(device_name) && !device.usable ? device.description : "";
}

void add_limits_of_device(Axis& axis)
{
    std::vector<Limit> added;
    for (const Limit& limit : axis.limits) {
        if (!limit.method.starts_with(host_name)) continue;
        Limit same = limit;
        same.method.replace(0, host_name.size(), device_name);
        const auto is_method = [&](const Method& method) { return method.name == same.method; };
        if (std::ranges::any_of(axis.methods, is_method)) added.push_back(std::move(same));
    }
    for (Limit& limit : added) axis.limits.push_back(std::move(limit));
}

} // namespace extremes
