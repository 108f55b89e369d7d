#include "device/info.hpp"

#include "base/environment.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <string_view>

namespace argand {

const char* to_string(DeviceKind kind) {
    switch (kind) {
    case DeviceKind::discrete:
        return "discrete GPU";
    case DeviceKind::integrated:
        return "integrated GPU";
    case DeviceKind::virtual_gpu:
        return "virtual GPU";
    case DeviceKind::cpu:
        return "CPU";
    case DeviceKind::other:
        return "other";
    }
    return "other";
}

namespace {

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        if (comma > 0) {
            parts.push_back(text.substr(0, comma));
        }
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return parts;
}

std::uint64_t parse_bytes(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    const std::map<std::string_view, std::uint64_t> units{
        {"", 1}, {"KiB", 1ull << 10}, {"MiB", 1ull << 20}, {"GiB", 1ull << 30}};
    const auto scale = units.find(unit);
    if (error != std::errc() || scale == units.end()) {
        throw UsageError(fmt::format(
            "reading ARGAND_LIMIT: '{}' is not a number of bytes; write e.g. 1MiB", text));
    }
    return value * scale->second;
}

template <class Map> std::string names_of(const Map& map) {
    std::string names;
    for (const auto& entry : map) {
        names += (names.empty() ? "" : ", ") + std::string(entry.first);
    }
    return names;
}

} // namespace

void apply_environment(DeviceInfo& info) {
    const std::map<std::string_view, bool*> switches{
        {"subgroups", &info.features.subgroups},
        {"push_descriptors", &info.features.push_descriptors},
        {"timestamps", &info.features.timestamps},
        {"raster", &info.features.raster},
        {"lane_serial", &info.features.lane_serial}};
    const std::string disabled = environment("ARGAND_DISABLE");
    for (const std::string_view name : split(disabled)) {
        const auto found = switches.find(name);
        if (found == switches.end()) {
            throw UsageError(
                fmt::format("reading ARGAND_DISABLE: '{}' is not known; choose from {}", name,
                            names_of(switches)));
        }
        *found->second = false;
    }

    const auto lower = [](auto& limit) {
        return [&limit](std::uint64_t value) {
            using T = std::remove_reference_t<decltype(limit)>;
            limit = static_cast<T>(std::min<std::uint64_t>(limit, value));
        };
    };
    const std::map<std::string_view, std::function<void(std::uint64_t)>> limits{
        {"storage_range", lower(info.limits.storage_range)},
        {"memory", lower(info.limits.memory)},
        {"invocations", lower(info.limits.invocations)},
        {"shared_memory", lower(info.limits.shared_memory)},
        {"storage_buffers", lower(info.limits.storage_buffers)},
        {"texels", lower(info.limits.texels)},
        {"groups", lower(info.limits.groups)},
        {"image", lower(info.limits.image)},
        {"layers", lower(info.limits.layers)}};
    const std::string limited = environment("ARGAND_LIMIT");
    for (const std::string_view setting : split(limited)) {
        const std::size_t equals = std::min(setting.find('='), setting.size());
        const auto found = limits.find(setting.substr(0, equals));
        if (found == limits.end() || equals == setting.size()) {
            throw UsageError(
                fmt::format("reading ARGAND_LIMIT: '{}' is not NAME=VALUE with a NAME from {}",
                            setting, names_of(limits)));
        }
        found->second(parse_bytes(setting.substr(equals + 1)));
    }
}

std::string unmet_requirement(const Limits& limits) {
    const auto check = [](const char* what, std::uint64_t has, std::uint64_t needs) {
        return has < needs ? fmt::format("{} is {}, Argand needs {}", what, has, needs)
                           : std::string();
    };
    for (const std::string& unmet :
         {check("its storage buffer range in bytes", limits.storage_range,
                Requirements::storage_range),
          check("its number of invocations per work-group", limits.invocations,
                Requirements::invocations),
          check("its shared memory in bytes", limits.shared_memory, Requirements::shared_memory),
          check("its number of storage buffers per shader stage", limits.storage_buffers,
                Requirements::storage_buffers)}) {
        if (!unmet.empty()) {
            return unmet;
        }
    }
    return {};
}

} // namespace argand
