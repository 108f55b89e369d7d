#include "compare/golden.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <zlib.h>

namespace argand {

namespace {

using Json = nlohmann::json;

constexpr int format = 1;
constexpr std::uint64_t most_bytes = std::uint64_t(1) << 30;

template <class T>
Json binary(const std::vector<T>& values) {
    std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return Json::binary(std::move(bytes));
}

template <class T>
std::vector<T> values_of(const Json& json) {
    const Json::binary_t& bytes = json.get_binary();
    if (bytes.size() % sizeof(T) != 0) {
        fail("its data are cut short");
    }
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

Json to_json(const GoldenCapture& capture) {
    Json steps = Json::array();
    for (const GoldenStep& step : capture) {
        Json writes = Json::array();
        for (const GoldenWrite& write : step.writes) {
            writes.push_back({binary(write.runs), binary(write.words)});
        }
        steps.push_back({step.stage, std::move(writes)});
    }
    return steps;
}

GoldenCapture capture_of(const Json& steps) {
    GoldenCapture capture;
    for (const Json& step : steps) {
        GoldenStep& made = capture.emplace_back();
        made.stage = step.at(0).get<std::string>();
        for (const Json& write : step.at(1)) {
            made.writes.push_back({values_of<GoldenWrite::Run>(write.at(0)), values_of<std::uint32_t>(write.at(1))});
        }
    }
    return capture;
}

Golden golden_of(const Json& json) {
    if (json.at("format").get<int>() != format) {
        fail("it has another format than this version reads");
    }
    Golden golden;
    golden.scene = json.at("scene").get<std::string>();
    golden.device = json.at("device").get<std::string>();
    golden.driver = json.at("driver").get<std::string>();
    golden.revision = json.at("revision").get<std::string>();
    golden.features.lane_serial = json.at("lane_serial").get<bool>();
    golden.width = json.at("width").get<int>();
    golden.height = json.at("height").get<int>();
    golden.samples = json.at("samples").get<std::uint32_t>();
    golden.seed = json.at("seed").get<std::uint32_t>();
    golden.photons = json.at("photons").get<std::uint64_t>();
    for (const auto& [method, steps] : json.at("captures").items()) {
        golden.captures[method] = capture_of(steps);
    }
    return golden;
}

/// zlib's stream, behind the number of bytes that it holds.
std::vector<std::uint8_t> packed(const std::vector<std::uint8_t>& bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::uint8_t> result(sizeof(std::uint64_t) + size);
    const std::uint64_t unpacked = bytes.size();
    std::memcpy(result.data(), &unpacked, sizeof(unpacked));
    compress2(result.data() + sizeof(unpacked), &size, bytes.data(), bytes.size(), Z_BEST_COMPRESSION);
    result.resize(sizeof(unpacked) + size);
    return result;
}

std::vector<std::uint8_t> unpacked(const std::vector<std::uint8_t>& bytes) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof(size)) {
        fail("it is cut short");
    }
    std::memcpy(&size, bytes.data(), sizeof(size));
    if (size > most_bytes) {
        fail("it is damaged");
    }
    std::vector<std::uint8_t> result(size);
    uLongf written = size;
    if (uncompress(result.data(), &written, bytes.data() + sizeof(size), bytes.size() - sizeof(size)) != Z_OK ||
        written != size) {
        fail("it is damaged");
    }
    return result;
}

} // namespace

GoldenWrite changes(std::span<const std::uint32_t> before, std::span<const std::uint32_t> after) {
    GoldenWrite write;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (before[i] == after[i]) {
            continue;
        }
        const auto at = static_cast<std::uint32_t>(i);
        if (write.runs.empty() || write.runs.back().first + write.runs.back().count != at) {
            write.runs.push_back({at, 0});
        }
        ++write.runs.back().count;
        write.words.push_back(after[i]);
    }
    return write;
}

void apply_changes(const GoldenWrite& write, std::span<std::uint32_t> words) {
    std::size_t from = 0;
    for (const GoldenWrite::Run& run : write.runs) {
        if (run.count > words.size() || run.first > words.size() - run.count || run.count > write.words.size() - from) {
            fail("comparing with a golden capture: it is of another scene or version; record it anew");
        }
        std::copy_n(write.words.begin() + static_cast<std::ptrdiff_t>(from), run.count,
                    words.begin() + static_cast<std::ptrdiff_t>(run.first));
        from += run.count;
    }
}

void write_golden(const std::filesystem::path& file, const Golden& golden) {
    Json captures = Json::object();
    for (const auto& [method, capture] : golden.captures) {
        captures[method] = to_json(capture);
    }
    const Json json = {{"format", format},
                       {"scene", golden.scene},
                       {"device", golden.device},
                       {"driver", golden.driver},
                       {"revision", golden.revision},
                       {"lane_serial", golden.features.lane_serial},
                       {"width", golden.width},
                       {"height", golden.height},
                       {"samples", golden.samples},
                       {"seed", golden.seed},
                       {"photons", golden.photons},
                       {"captures", std::move(captures)}};
    write_atomically(file, packed(Json::to_msgpack(json)));
}

Golden read_golden(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    try {
        return golden_of(Json::from_msgpack(unpacked(bytes)));
    } catch (const Json::exception&) {
        fail("reading golden capture '{}': it is not one; record it with `argand compare-backends --record`", file.string());
    } catch (const Error& error) {
        fail("reading golden capture '{}': {}; record it anew with `argand compare-backends --record`", file.string(),
             error.what());
    }
}

} // namespace argand
