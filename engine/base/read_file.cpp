#include "base/read_file.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include <fstream>
#include <system_error>

namespace argand {

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
    const std::string name = one_line(path.string());
    std::error_code problem;
    const std::filesystem::file_status status = std::filesystem::status(path, problem);
    if (status.type() == std::filesystem::file_type::not_found) {
        fail("cannot read '{}': there is no such file", name);
    }
    if (problem) {
        fail("cannot read '{}': {}", name, problem.message());
    }
    if (std::filesystem::is_directory(status)) {
        fail("cannot read '{}': it is a directory", name);
    }
    // A pipe or a device could block for ever or never end.
    if (!std::filesystem::is_regular_file(status)) {
        fail("cannot read '{}': it is not a regular file", name);
    }
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    std::ifstream stream(path, std::ios::binary);
    if (problem || !stream) {
        fail("cannot read '{}': it cannot be opened; check its permissions", name);
    }
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
        fail("cannot read '{}': only {} of {} bytes could be read", name, stream.gcount(), size);
    }
    return bytes;
}

} // namespace argand
