#pragma once

#include "image/picture_settings.hpp"
#include <filesystem>
#include <span>
#include <vector>

namespace argand {

/// Writes layers of one size to one OpenEXR file, in one step (base/atomic_write.hpp): linear
/// 32-bit floats, ZIP compression, channels R, G, B for the layer "" and NAME.R, NAME.G, NAME.B for
/// the others (NAME.X, ... where a layer says so), the command as the attribute "comments", and the
/// window as the data window. Throws Error if there is no layer, if two layers have the same name
/// or different sizes, or if the file cannot be written.
void write_exr(const std::filesystem::path& path, std::span<const Layer> layers,
               const PictureSettings& settings = {});

/// Reads the layers of an OpenEXR file, sorted by name, which puts the layer "" first. Samples may
/// be half, float or integer, stored as scan lines or tiles (of which the finest level is read).
/// The image covers the data window. A layer with the channel Y alone is grey; a missing R, G or B
/// is 0. A layer other than "" may have X, Y and Z instead, where a missing one is 0, too. Other
/// channels are ignored. Throws Error, naming the file and the reason, if the file is
/// damaged, is deep, multi-part or sub-sampled, has no layer, is larger than image_size.hpp allows,
/// or is compressed otherwise than by RLE, ZIP, PIZ or PXR24.
std::vector<Layer> read_exr(const std::filesystem::path& path);

} // namespace argand
