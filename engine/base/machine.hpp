#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace argand {

/// Bytes of memory that the machine has; a guess of 2 GiB where that cannot be asked.
std::uint64_t physical_memory();

/// What the machine's processor calls itself, or "processor".
std::string processor_name();

/// The program that runs: its executable file.
std::filesystem::path program_file();

} // namespace argand
