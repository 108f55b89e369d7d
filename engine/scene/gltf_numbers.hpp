#pragma once

#include <nlohmann/json.hpp>

namespace argand {

/// Rewrites integers that are written as 1.0 or 1e3, which JSON allows, as integers: indices, sizes
/// and all numbers of extensions. Skips extras. Returns whether there are any.
bool rewrite_integers(nlohmann::json& root);

/// Gives indices whose data is compressed (KHR_draco_mesh_compression) a buffer view, which
/// tinygltf requires. Returns whether there are any. decompress() gives them another one.
bool give_indices_views(nlohmann::json& root);

/// Gives a byte of data to buffers that have none because they only stand in for compressed ones
/// (EXT_meshopt_compression, "fallback"). Returns whether there are any.
bool fill_fallback_buffers(nlohmann::json& root);

} // namespace argand
