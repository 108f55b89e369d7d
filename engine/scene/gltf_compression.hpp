#pragma once

#include "scene/gltf_source.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// Replaces compressed data of the file by what it stands for: buffer views with
/// EXT_meshopt_compression, and primitives with KHR_draco_mesh_compression. What follows reads
/// buffers that are not compressed. Where this build lacks the library that an extension needs, the
/// data without compression is read, which is there unless the file requires the extension. Throws
/// Error, which names the view or the mesh, if the data is damaged, or is not what the file says.
void decompress(GltfSource& source);

/// The Debian package without which this build cannot read an extension, or null if it can.
const char* missing_package(std::string_view extension);

/// Names of the extensions of compression.
inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";
inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";

// The parts of decompress(). They do nothing in a build without the library.
void decompress_meshopt(GltfSource& source);
void decompress_draco(GltfSource& source);

/// Bytes [offset, offset + length) of buffer `buffer`. Throws Error, beginning with `what`, if they
/// are not there.
std::span<const std::uint8_t> bytes_of_buffer(const GltfSource& source, std::size_t buffer,
                                              std::size_t offset, std::size_t length,
                                              const std::string& what);

/// An integer from 0 to 2^53 in an extension's object. Throws Error, beginning with `what`, if it
/// is missing (and there is no `otherwise`) or something else.
std::size_t size_in_extension(const GltfSource& source, const nlohmann::json& object,
                              const char* key, std::optional<std::size_t> otherwise,
                              const std::string& what);

/// Adds a buffer with these bytes to the file, and returns its index.
int add_buffer(GltfSource& source, std::vector<unsigned char> bytes);

} // namespace argand
