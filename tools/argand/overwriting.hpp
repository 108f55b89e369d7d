#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace argand {

/// Throws UsageError if writing `target` would replace one of the files `others`, however their
/// paths are spelled.
void check_overwrites_none(const std::string& target, const std::vector<std::string>& others);

/// The same if one of `targets` would replace a file from which the scene was loaded. Empty ones
/// are skipped.
void check_overwrites_no_file_of(const Scene& scene, const std::vector<std::string>& targets);

} // namespace argand
