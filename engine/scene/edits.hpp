#pragma once

#include "scene/atmosphere.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace argand {

// Changes to a loaded scene, which its file does not know. What they do not name stays as the file
// states it. Objects are named, or given by their index in the file.

/// A node's transform relative to its parent, in the place of the file's and of its animations.
struct NodeEdit {
    std::optional<glm::dvec3> translation, scale;
    std::optional<glm::dquat> rotation; ///< unit
};

/// A light in world space; it no longer follows its node or animations.
struct LightEdit {
    std::optional<glm::dvec3> position;
    std::optional<glm::dvec3> direction; ///< in which light travels; unit
    std::optional<glm::dvec3> intensity; ///< colour × intensity: [cd], directional: [lux]
};

/// A material's properties, as in Material; it no longer follows animations.
struct MaterialEdit {
    std::optional<glm::dvec3> base_color, emission;
    std::optional<double> metallic, roughness, specular, transmission, ior, coat, coat_roughness;
};

/// A camera in world space; it no longer follows its node or animations.
struct CameraEdit {
    std::optional<glm::dvec3> position;
    std::optional<glm::dvec3> target;     ///< a point in the picture's middle
    std::optional<glm::dvec3> up;         ///< unit; about upwards in the picture
    std::optional<double> vertical_angle; ///< [degrees] perspective
};

struct Edits {
    bool has_nodes = false; ///< there is a member "nodes", maybe an empty one: nodes can be moved
    std::map<std::string, NodeEdit> nodes;
    std::map<std::string, LightEdit> lights;
    std::map<std::string, MaterialEdit> materials;
    std::map<std::string, CameraEdit> cameras;
    std::optional<SunPosition> sun; ///< a clear sky in the place of the scene's
};

/// Reads edits (docs/edits.md). source: of the text, for messages. Throws Error, which names the
/// member, if there is an unknown one or one of a wrong kind or range.
Edits parse_edits(const nlohmann::json& json, const std::string& source);

} // namespace argand
