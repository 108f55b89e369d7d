#include "scene/pose.hpp"

#include "base/error.hpp"
#include "scene/direction.hpp"
#include "scene/moving_factors.hpp"
#include "scene/placement.hpp"

#include <utility>

namespace argand {
namespace {

glm::dvec3 vector_at(const KeyFrames& keys, double seconds) {
    const std::vector<double> value = value_at(keys, seconds);
    return {value[0], value[1], value[2]};
}

LocalTransform local_at(const MotionNode& node, std::optional<double> seconds) {
    LocalTransform local = node.rest;
    if (seconds && node.keys.translation) {
        local.translation = vector_at(*node.keys.translation, *seconds);
    }
    if (seconds && node.keys.rotation) {
        local.rotation = rotation_at(*node.keys.rotation, *seconds);
    }
    if (seconds && node.keys.scale) {
        local.scale = vector_at(*node.keys.scale, *seconds);
    }
    return local;
}

glm::dmat4 to_matrix(const LocalTransform& local) {
    if (local.matrix) {
        return *local.matrix;
    }
    glm::dmat4 transform = glm::mat4_cast(local.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        transform[axis] *= local.scale[axis];
    }
    transform[3] = glm::dvec4(local.translation, 1);
    return transform;
}

/// A vertex in object space, in double precision.
struct ObjectVertex {
    glm::dvec3 position, normal;
};

ObjectVertex morphed(const MovingMesh& mesh, std::size_t vertex,
                     const std::vector<double>& weights) {
    ObjectVertex result{mesh.positions[vertex], mesh.normals[vertex]};
    for (std::size_t i = 0; i < mesh.targets.size(); ++i) {
        const MorphTarget& target = mesh.targets[i];
        if (!target.positions.empty()) {
            result.position += weights[i] * glm::dvec3(target.positions[vertex]);
        }
        if (!target.normals.empty()) {
            result.normal += weights[i] * glm::dvec3(target.normals[vertex]);
        }
    }
    return result;
}

/// The transform of a vertex that joints carry: glTF 2.0, section 3.7.3.3.
glm::dmat4 blended(const std::vector<glm::dmat4>& world_from_mesh, const JointWeights& by) {
    glm::dmat4 sum(0);
    for (std::size_t k = 0; k < by.joints.size(); ++k) {
        if (by.weights[k] > 0) {
            sum += double(by.weights[k]) * world_from_mesh[by.joints[k]];
        }
    }
    return sum;
}

/// Lists the mesh's triangles so that they face the right way under its node's transform. A joint
/// may mirror as well, but then a triangle's corners may disagree.
void orient(MovingMesh& mesh, const VertexTransform& of_node, Scene& scene) {
    const bool mirrors = mesh.skin < 0 && of_node.mirrors;
    for (std::size_t i = 0; mirrors != mesh.mirrored && i < mesh.triangles; ++i) {
        glm::uvec3& triangle = scene.triangles[mesh.first_triangle + i];
        std::swap(triangle.y, triangle.z);
    }
    mesh.mirrored = mirrors;
}

void check_position(const glm::vec3& position, const char* what, const std::string& name,
                    const Scene& scene) {
    if (!is_finite(position)) {
        fail("posing '{}': {} '{}' has a position that is not finite", scene.name, what, name);
    }
}

/// Moves all but meshes.
void move_the_rest(const Pose& pose, std::optional<double> seconds, Scene& scene) {
    for (const MovingLight& moving : scene.motion.lights) {
        Light& light = scene.lights[moving.index] = moving.light;
        if (moving.keys >= 0) {
            const LightKeys& keys = scene.motion.light_keys[std::size_t(moving.keys)];
            set_factors(seconds ? factors_at(keys, moving.factors, *seconds) : moving.factors,
                        light);
        }
        if (!place(pose.world_from_node[moving.node], light)) {
            light.intensity = glm::vec3(0);
        }
        check_position(light.position, "light", light.name, scene);
    }
    for (const MovingCamera& moving : scene.motion.cameras) {
        Camera& camera = scene.cameras[moving.index] = moving.camera;
        if (seconds && moving.keys >= 0) {
            set_view(scene.motion.camera_keys[std::size_t(moving.keys)], *seconds, camera);
        }
        place(pose.world_from_node[moving.node], camera);
        check_position(camera.position, "camera", camera.name, scene);
    }
    for (const MovingMaterial& moving : scene.motion.materials) {
        set_factors(seconds ? factors_at(moving, *seconds) : moving.factors,
                    scene.materials[moving.index]);
    }
    scene.seconds = seconds;
}

} // namespace

Pose pose_at(const Motion& motion, std::optional<double> seconds) {
    Pose pose;
    pose.world_from_node.reserve(motion.nodes.size());
    pose.morph_weights.reserve(motion.nodes.size());
    for (const MotionNode& node : motion.nodes) {
        const glm::dmat4 parent =
            node.parent < 0 ? glm::dmat4(1) : pose.world_from_node[std::size_t(node.parent)];
        pose.world_from_node.push_back(parent * to_matrix(local_at(node, seconds)));
        pose.morph_weights.push_back(
            seconds && node.keys.weights ? value_at(*node.keys.weights, *seconds) : node.weights);
    }
    return pose;
}

std::vector<glm::dmat4> joint_transforms(const Skin& skin, const Pose& pose) {
    std::vector<glm::dmat4> world_from_mesh;
    world_from_mesh.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        world_from_mesh.push_back(pose.world_from_node[skin.joints[i]] * skin.joint_from_mesh[i]);
    }
    return world_from_mesh;
}

std::vector<bool> moving_nodes(const Motion& motion) {
    std::vector<bool> moves;
    moves.reserve(motion.nodes.size());
    for (const MotionNode& node : motion.nodes) {
        moves.push_back(node.movable || node.keys.moves_transform() ||
                        (node.parent >= 0 && moves[std::size_t(node.parent)]));
    }
    return moves;
}

void place(MovingMesh& mesh, const Pose& pose, Scene& scene) {
    const Skin* skin = mesh.skin < 0 ? nullptr : &scene.motion.skins[std::size_t(mesh.skin)];
    const std::vector<glm::dmat4> joints =
        skin ? joint_transforms(*skin, pose) : std::vector<glm::dmat4>();
    const VertexTransform of_node = vertex_transform(pose.world_from_node[mesh.node]);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const ObjectVertex vertex = morphed(mesh, i, pose.morph_weights[mesh.node]);
        const VertexTransform transform =
            skin ? vertex_transform(blended(joints, mesh.joint_weights[i])) : of_node;
        const glm::dvec3 position(transform.point * glm::dvec4(vertex.position, 1));
        if (!fits_float(position)) {
            fail("posing '{}': a vertex of {} has a position that is not finite in world space",
                 scene.name, mesh.name);
        }
        scene.positions[mesh.first_vertex + i] = glm::vec3(position);
        scene.normals[mesh.first_vertex + i] =
            glm::vec3(unit_or_zero(transform.normal * vertex.normal));
    }
    orient(mesh, of_node, scene);
}

void move_to(std::optional<double> seconds, Scene& scene) {
    const Pose pose = pose_at(scene.motion, seconds);
    for (MovingMesh& mesh : scene.motion.meshes) {
        place(mesh, pose, scene);
    }
    move_the_rest(pose, seconds, scene);
}

void move_without_vertices(std::optional<double> seconds, Scene& scene) {
    const Pose pose = pose_at(scene.motion, seconds);
    for (MovingMesh& mesh : scene.motion.meshes) {
        orient(mesh, vertex_transform(pose.world_from_node[mesh.node]), scene);
    }
    move_the_rest(pose, seconds, scene);
}

} // namespace argand
