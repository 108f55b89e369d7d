#pragma once

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/gltf.hpp"
#include "scene/scene.hpp"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>

namespace argand {

/// A parsed glTF file from which a Scene is built.
struct GltfSource {
    tinygltf::Model model;
    nlohmann::json root; ///< the raw JSON: for extensions, whose integers tinygltf would wrap
    std::string file;    ///< file name for messages
    std::filesystem::path directory; ///< of the file: URIs are relative to it
    LoadOptions options;

    /// Throws Error: "cannot load 'FILE': ...".
    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        argand::fail("cannot load '{}': {}", file,
                     fmt::format(format, std::forward<Args>(args)...));
    }
};

/// Name of an object of the file in messages: mesh 3 "Name".
inline std::string label(const char* kind, int index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index)
                        : fmt::format("{} {} \"{}\"", kind, index, one_line(name, 60));
}

/// Adds a note for the user unless the scene already has it.
inline void add_note(Scene& scene, const std::string& note) {
    for (const std::string& said : scene.notes) {
        if (said == note) {
            return;
        }
    }
    scene.notes.push_back(note);
}

} // namespace argand
