#include "base/json.hpp"

#include "base/atomic_write.hpp"

namespace argand {

std::string json_text(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_json(const std::filesystem::path& target, const nlohmann::ordered_json& value) {
    write_atomically(target, json_text(value));
}

} // namespace argand
