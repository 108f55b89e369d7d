#pragma once

#include "image/image.hpp"
#include <filesystem>
#include <span>
#include <vector>

namespace argand {

/// Writes layers of one size as one OpenEXR file in one step: linear 32-bit floats, ZIP
/// compression, channels R, G, B for the layer "" and NAME.R, NAME.G, NAME.B for the others. Error
/// if there is no layer, two have one name, sizes differ, or the file cannot be written.
void write_exr(const std::filesystem::path& path, std::span<const Layer> layers);

/// Reads the layers of a single-part scan-line OpenEXR file, the layer "" first, the others by
/// name. Half, float and integer samples; a layer with Y alone is grey, and of R, G, B what is
/// missing is 0; other channels are left out. Error, naming file and reason, if the file is
/// damaged, of another kind (tiled, deep, multi-part, sub-sampled), of a compression other than
/// none, RLE, ZIP, PIZ, or has no layer.
std::vector<Layer> read_exr(const std::filesystem::path& path);

} // namespace argand
