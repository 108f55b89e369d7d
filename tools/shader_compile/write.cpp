#include "write.hpp"

#include "base/atomic_write.hpp"
#include "sources.hpp"

namespace argand::shader_compile {

void write_if_changed(const std::filesystem::path& path, std::string_view text) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable) || read_text(path) != text) {
        write_atomically(path, text);
    }
}

} // namespace argand::shader_compile
