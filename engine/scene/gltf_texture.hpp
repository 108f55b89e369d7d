#pragma once

#include "scene/gltf_source.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace argand {

/// Reads the textures that materials use, and remembers their images.
class TextureReader {
public:
    TextureReader(const GltfSource& source, Scene& scene) : source_(source), scene_(scene) {}

    /// Adds the texture that `owner` refers to by `key` to the scene's textures. what: names the
    /// material. Returns false if it refers to none, or with a note to one in a format that is not
    /// supported. Throws Error if what it refers to does not exist or is not valid.
    bool add(const nlohmann::json* owner, const char* key, TextureUse use, const std::string& what,
             float scale = 1);

    /// The same checks for a texture that is not used. Its image is not read.
    void check(const nlohmann::json* owner, const char* key, const std::string& what);

    /// Decodes the images of all textures that were added, on all cores. Throws Error if one cannot
    /// be read.
    void decode_images();

private:
    std::optional<Texture> read(const nlohmann::json* owner, const char* key,
                                const std::string& what, std::size_t& image);
    std::uint32_t image_of(std::size_t in_file);

    const GltfSource& source_;
    Scene& scene_;
    std::vector<std::size_t> images_; ///< indices in the file, in the order of Scene::images
};

} // namespace argand
