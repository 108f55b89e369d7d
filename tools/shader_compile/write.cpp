#include "write.hpp"

#include "base/error.hpp"
#include "sources.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace argand::shader_compile {
namespace fs = std::filesystem;

void write_file(const fs::path& path, std::string_view text) {
    if (fs::is_regular_file(path) && read_text(path) == text) {
        return;
    }
    fs::path unfinished = path;
    unfinished += ".tmp";
    std::ofstream file(unfinished, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    std::error_code renamed;
    if (file) {
        fs::rename(unfinished, path, renamed);
    }
    if (!file || renamed) {
        const std::string reason = renamed ? renamed.message() : std::strerror(errno);
        std::error_code ignored;
        fs::remove(unfinished, ignored);
        fail("cannot write {}: {}", path.string(), reason);
    }
}

} // namespace argand::shader_compile
