#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace argand {

/// The machine's physical memory in bytes, or 2 GiB if the system does not report it.
std::uint64_t physical_memory();

/// The processor's name as the system reports it, or "processor".
std::string processor_name();

/// Path of the running program's executable file.
std::filesystem::path program_file();

/// Fingerprint of that file in hexadecimal: another build may render other pictures.
std::string program_fingerprint();

} // namespace argand
