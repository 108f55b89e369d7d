#include "base/json.hpp"

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"

#include <cstdint>
#include <vector>

namespace argand {

namespace {

constexpr int most_levels = 64;

} // namespace

std::string json_text(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::json read_json(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    try {
        // What handles JSON calls itself for each level.
        return nlohmann::json::parse(bytes, [&](int depth, auto, const auto&) {
            if (depth > most_levels) {
                fail("reading '{}': its JSON is nested more than {} levels deep", path.string(),
                     most_levels);
            }
            return true;
        });
    } catch (const nlohmann::json::exception& error) { // a syntax error, or a number out of range
        fail("reading '{}': it is no JSON: {}", path.string(), one_line(error.what(), 160));
    }
}

void write_json(const std::filesystem::path& target, const nlohmann::ordered_json& value) {
    write_atomically(target, json_text(value));
}

} // namespace argand
