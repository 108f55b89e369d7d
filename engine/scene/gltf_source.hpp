#pragma once

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/scene.hpp"
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>

namespace argand {

/// A parsed glTF file while a Scene is made of it.
struct GltfSource {
    tinygltf::Model model;
    nlohmann::json root; ///< the JSON itself: for extensions, whose integers tinygltf would wrap
    std::string file;    ///< as messages name it

    /// Throws Error: "cannot load 'FILE': ...".
    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        argand::fail("cannot load '{}': {}", file,
                     fmt::format(format, std::forward<Args>(args)...));
    }
};

/// "mesh 3 "Name"": how a message names an object of the file.
inline std::string label(const char* kind, int index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index)
                        : fmt::format("{} {} \"{}\"", kind, index, one_line(name, 60));
}

/// Adds a note for the user unless it has been said already.
inline void add_note(Scene& scene, const std::string& note) {
    for (const std::string& said : scene.notes) {
        if (said == note) {
            return;
        }
    }
    scene.notes.push_back(note);
}

} // namespace argand
