#pragma once

#include "scene/camera.hpp"
#include "scene/factors.hpp"
#include "scene/key_frames.hpp"
#include "scene/light.hpp"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// A node's transform relative to its parent: scale, then rotation, then translation.
struct LocalTransform {
    std::optional<glm::dmat4> matrix; ///< instead of the others
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0}; ///< unit
};

/// The properties of a node that animations move.
struct NodeKeys {
    std::optional<KeyFrames> translation, rotation, scale;
    std::optional<KeyFrames> weights; ///< of the morph targets of the node's mesh
    bool moves_transform() const { return translation || rotation || scale; }
};

/// A node of the file's hierarchy.
struct MotionNode {
    std::uint32_t index = 0; ///< in the file; instances of a mesh have that of their node
    std::string name;
    int parent = -1;             ///< index of a node before this one; -1: none
    LocalTransform rest;         ///< as the file states it
    std::vector<double> weights; ///< of morph targets at rest
    NodeKeys keys;
    bool movable = false; ///< its transform at rest may change (scene/edits.hpp)
};

/// Joints that carry a mesh's vertices (glTF 2.0, section 3.7.3).
struct Skin {
    std::vector<std::uint32_t> joints;       ///< indices of nodes
    std::vector<glm::dmat4> joint_from_mesh; ///< inverse bind matrix of each joint
};

/// The joints that carry a vertex: indices into Skin::joints, and weights that sum to 1.
struct JointWeights {
    std::array<std::uint32_t, 4> joints{};
    std::array<float, 4> weights{};
};

/// What a morph target adds to each vertex, times its weight. Empty: nothing.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals;
};

/// A primitive of a mesh whose vertices move, in object space.
struct MovingMesh {
    std::string name;       ///< for messages
    std::uint32_t node = 0; ///< that shows it
    int skin = -1;          ///< index into Motion::skins; -1: the node's transform moves it
    // Where it lies in the scene. Its triangles follow each other, and so do its vertices.
    std::size_t first_vertex = 0, first_triangle = 0, triangles = 0;
    bool mirrored = false; ///< its triangles are listed now for a transform that mirrors
    std::vector<glm::vec3> positions, normals; ///< (0,0,0): use the geometric normal
    std::vector<JointWeights> joint_weights;   ///< of each vertex; empty without a skin
    std::vector<MorphTarget> targets;
};

/// The properties of a light that animations move.
struct LightKeys {
    std::optional<KeyFrames> color, intensity, inner_cone_angle, outer_cone_angle;
    bool moves() const { return color || intensity || inner_cone_angle || outer_cone_angle; }
};

/// A light that a moving node carries, or whose properties move.
struct MovingLight {
    std::uint32_t node = 0;
    std::size_t index = 0; ///< into Scene::lights
    Light light;           ///< in object space
    int keys = -1;         ///< index into Motion::light_keys; -1: its properties rest
    LightFactors factors;  ///< at rest; they count if it has keys
};

/// The properties of a camera that animations move.
struct CameraKeys {
    std::optional<KeyFrames> vertical_angle, vertical_extent;
    bool moves() const { return vertical_angle || vertical_extent; }
};

/// A camera that a moving node carries, or whose properties move.
struct MovingCamera {
    std::uint32_t node = 0;
    std::size_t index = 0; ///< into Scene::cameras
    Camera camera;         ///< in object space
    int keys = -1;         ///< index into Motion::camera_keys; -1: its properties rest
};

/// The properties of a material that animations move.
struct MaterialKeys {
    std::optional<KeyFrames> base_color, metallic, roughness, alpha_cutoff;
    std::optional<KeyFrames> emissive, emissive_strength;
    std::optional<KeyFrames> specular, specular_color;
    std::optional<KeyFrames> transmission, ior, thickness;
    std::optional<KeyFrames> attenuation_color, attenuation_distance;
    std::optional<KeyFrames> coat, coat_roughness, dispersion;
    std::optional<KeyFrames> sheen_color, sheen_roughness;
    std::optional<KeyFrames> anisotropy, anisotropy_rotation;
    std::optional<KeyFrames> iridescence, iridescence_ior, iridescence_thickness;
    bool moves_alpha() const { return base_color || alpha_cutoff; }
    bool moves() const {
        return moves_alpha() || metallic || roughness || emissive || emissive_strength ||
               specular || specular_color || transmission || ior || thickness ||
               attenuation_color || attenuation_distance || coat || coat_roughness || dispersion ||
               sheen_color || sheen_roughness || anisotropy || anisotropy_rotation || iridescence ||
               iridescence_ior || iridescence_thickness;
    }
};

/// A material whose properties move.
struct MovingMaterial {
    std::size_t index = 0;   ///< into Scene::materials
    MaterialFactors factors; ///< at rest
    MaterialKeys keys;
};

/// What moves in a scene, as its file states it. Everything is empty if nothing moves.
struct Motion {
    std::vector<MotionNode> nodes; ///< parents before children
    std::vector<Skin> skins;
    std::vector<MovingMesh> meshes;
    std::vector<MovingLight> lights;
    std::vector<MovingCamera> cameras;
    // Several nodes may carry one light or camera of the file.
    std::vector<LightKeys> light_keys;
    std::vector<CameraKeys> camera_keys;
    std::vector<MovingMaterial> materials; ///< by rising index
};

} // namespace argand
