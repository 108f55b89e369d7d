#pragma once

#include "scene/gltf_keys.hpp"
#include "scene/motion.hpp"
#include <string_view>
#include <vector>

namespace argand {

/// The keys of a file's objects, by their indices in the file.
struct FileKeys {
    std::vector<NodeKeys> nodes;
    std::vector<LightKeys> lights;
    std::vector<MaterialKeys> materials;
    std::vector<CameraKeys> cameras;
};

/// Keys for each object of the file, all of them empty.
FileKeys no_keys(const GltfSource& source);

/// What a channel moves that names a node and its property (glTF 2.0, section 5.5). `what` names
/// the animation in messages. Throws Error if the node does not exist or has no such property.
KeyTarget node_target(const GltfSource& source, std::size_t index, std::string_view property,
                      FileKeys& keys, const std::string& what);

/// What a channel moves that points to a property (KHR_animation_pointer); nothing if that is not
/// supported. Throws Error if the object does not exist or has no such property.
KeyTarget pointer_target(const GltfSource& source, std::string_view pointer, FileKeys& keys,
                         const std::string& what);

} // namespace argand
