#include "base/machine.hpp"

#include "base/fingerprint.hpp"
#include "base/read_file.hpp"
#include <fmt/format.h>

#include <fstream>
#include <span>

#ifdef _WIN32
#define NOMINMAX
#include <windows.h>
#else
#include <unistd.h>
#endif

namespace argand {

std::uint64_t physical_memory() {
#ifdef _WIN32
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    if (GlobalMemoryStatusEx(&status) != 0) {
        return status.ullTotalPhys;
    }
#else
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page = sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && page > 0) {
        return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
    }
#endif
    return std::uint64_t(2) << 30;
}

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "processor";
}

std::filesystem::path program_file() {
#ifdef _WIN32
    std::wstring name(1 << 15, L'\0'); // the longest path that Windows allows
    name.resize(GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
    return name;
#else
    return "/proc/self/exe";
#endif
}

std::string program_fingerprint() {
    const std::vector<std::uint8_t> program = read_file(program_file());
    return fmt::format("{:016x}", fingerprint(std::as_bytes(std::span(program))));
}

} // namespace argand
