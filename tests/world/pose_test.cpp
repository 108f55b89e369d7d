// Vertices of moving meshes placed by a device, compared with the host, which does it in double
// precision.
#include "device_fixture.hpp"
#include "scene/pose.hpp"
#include "world/moving_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace argand {
namespace {

/// How large the numbers of a scene are.
struct Magnitudes {
    double object = 1;      ///< extent of a mesh in its own space
    double off = 0;         ///< its distance from the origin there
    double scale = 1;       ///< of nodes
    double translation = 1; ///< of nodes
};

class RandomScene {
public:
    explicit RandomScene(const Magnitudes& of) : of_(of) {
        scene.name = "random";
        scene.seconds = 0;
        for (int i = 0; i < 6; ++i) {
            scene.motion.nodes.push_back(node());
        }
    }

    /// Skins have their own inverse bind matrices: those that bring the mesh to the origin.
    void add_skin(const std::vector<std::uint32_t>& joints) {
        Skin skin{.joints = joints};
        for (std::size_t i = 0; i < joints.size(); ++i) {
            glm::dmat4 from_mesh(1);
            from_mesh[3] = glm::dvec4(-of_.off + uniform(), uniform(), uniform(), 1);
            skin.joint_from_mesh.push_back(from_mesh);
        }
        scene.motion.skins.push_back(std::move(skin));
    }

    void add_mesh(std::size_t vertices, int skin, std::size_t targets) {
        MovingMesh mesh{.name = "mesh",
                        .node = static_cast<std::uint32_t>(scene.motion.meshes.size() % 6),
                        .skin = skin,
                        .first_vertex = scene.positions.size() + 3, // others rest
                        .first_triangle = scene.triangles.size()};
        for (std::size_t v = 0; v < vertices; ++v) {
            mesh.positions.push_back(glm::vec3(float(of_.off), 0, 0) + vector(of_.object));
            mesh.normals.push_back(v % 7 == 3 ? glm::vec3(0) : glm::normalize(vector(1)));
            if (skin >= 0) {
                mesh.joint_weights.push_back(joints_of_vertex(skin));
            }
        }
        for (std::size_t t = 0; t < targets; ++t) {
            MorphTarget target;
            for (std::size_t v = 0; v < vertices; ++v) {
                target.positions.push_back(vector(of_.object));
                target.normals.push_back(vector(0.5));
            }
            if (t == 1) {
                target.positions.clear();
            }
            if (t == 2) {
                target.normals.clear();
            }
            mesh.targets.push_back(std::move(target));
        }
        scene.motion.nodes[mesh.node].weights.resize(
            std::max(targets, scene.motion.nodes[mesh.node].weights.size()));
        for (double& weight : scene.motion.nodes[mesh.node].weights) {
            weight = uniform() < -0.5 ? 0 : 2 * uniform();
        }
        scene.positions.resize(mesh.first_vertex + vertices, glm::vec3(5));
        scene.normals.resize(scene.positions.size(), glm::vec3(0));
        for (std::size_t v = 0; v + 2 < vertices; ++v) {
            const auto first = static_cast<std::uint32_t>(mesh.first_vertex + v);
            scene.triangles.emplace_back(first, first + 1, first + 2);
            scene.triangle_material.push_back(0);
            ++mesh.triangles;
        }
        scene.motion.meshes.push_back(std::move(mesh));
    }

    Scene scene;

private:
    double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    glm::vec3 vector(double size) { return {size * uniform(), size * uniform(), size * uniform()}; }

    MotionNode node() {
        MotionNode result;
        result.rest.rotation =
            glm::normalize(glm::dquat(uniform(), uniform(), uniform(), uniform()));
        result.rest.scale = of_.scale * glm::dvec3(1 + 0.5 * uniform(), 1 + 0.5 * uniform(),
                                                   uniform() < 0 ? -1 : 1);
        // What is far from its own origin is brought back to that of the world.
        result.rest.translation =
            of_.translation * glm::dvec3(uniform(), uniform(), uniform()) -
            result.rest.rotation * (result.rest.scale * glm::dvec3(of_.off, 0, 0));
        return result;
    }

    JointWeights joints_of_vertex(int skin) {
        const std::size_t count = scene.motion.skins[static_cast<std::size_t>(skin)].joints.size();
        JointWeights by;
        float left = 1;
        for (std::size_t k = 0; k < 4; ++k) {
            by.joints[k] = random_() % static_cast<std::uint32_t>(count);
            by.weights[k] = k == 3             ? left
                            : uniform() < -0.4 ? 0
                                               : left * float(0.5 + 0.5 * uniform());
            left -= by.weights[k];
        }
        return by;
    }

    Magnitudes of_;
    std::mt19937 random_{5};
};

struct Placed {
    std::vector<glm::vec4> positions, normals;
};

Placed placed_by(Device& device, const Scene& scene, MovingMeshes& meshes) {
    const std::vector<glm::vec4> before(scene.positions.size(), glm::vec4(7));
    const Buffer positions = upload(device, "positions", before);
    const Buffer normals = upload(device, "normals", before);
    meshes.place(positions, &normals);
    return {download<glm::vec4>(device, positions, before.size()),
            download<glm::vec4>(device, normals, before.size())};
}

double ulp(float x) {
    const float size = std::max(std::abs(x), std::numeric_limits<float>::min());
    return double(std::nextafter(size, std::numeric_limits<float>::infinity())) - double(size);
}

/// Compares with the host. Positions differ by an ULP at most, and by what twice single precision
/// leaves of `largest`, a bound of all terms of their sums; normals by a few ULPs of 1. Mostly both
/// round the same sum alike: no larger share of the coordinates differs than `most_differ`.
void expect_as_by_host(Device& device, Scene scene, double largest, double most_differ = 0.01) {
    MovingMeshes meshes(device, scene);
    const Placed placed = placed_by(device, scene, meshes);
    move_to(0, scene);
    std::vector<bool> moves(scene.positions.size(), false);
    std::size_t differ = 0, all = 0;
    for (const MovingMesh& mesh : scene.motion.meshes) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const std::size_t at = mesh.first_vertex + v;
            moves[at] = true;
            for (int k = 0; k < 3; ++k) {
                const float expected = scene.positions[at][k];
                ASSERT_NEAR(placed.positions[at][k], expected,
                            ulp(expected) + std::ldexp(largest, -44))
                    << at;
                differ += placed.positions[at][k] != expected ? 1 : 0;
                ++all;
                ASSERT_NEAR(placed.normals[at][k], scene.normals[at][k], 2e-6) << at;
            }
        }
    }
    for (std::size_t i = 0; i < moves.size(); ++i) {
        EXPECT_TRUE(moves[i] || placed.positions[i] == glm::vec4(7)) << i;
        EXPECT_TRUE(moves[i] || placed.normals[i] == glm::vec4(7)) << i;
    }
    EXPECT_LE(static_cast<double>(differ), most_differ * static_cast<double>(all));
    for (std::size_t m = 0; m < scene.motion.meshes.size(); ++m) {
        const MovingMesh& mesh = scene.motion.meshes[m];
        Bounds box;
        for (std::size_t t = 0; t < 3 * mesh.triangles; ++t) {
            const glm::uvec3& triangle = scene.triangles[mesh.first_triangle + t / 3];
            const glm::vec3 p(placed.positions[triangle[static_cast<int>(t % 3)]]);
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
        EXPECT_EQ(meshes.boxes(scene)[m].low, box.low) << m;
        EXPECT_EQ(meshes.boxes(scene)[m].high, box.high) << m;
    }
}

using PoseVertices = DeviceTest;

Scene scene_of(const Magnitudes& magnitudes, const std::vector<std::size_t>& sizes) {
    RandomScene random(magnitudes);
    random.add_skin({0, 3, 4});
    random.add_skin({2, 5, 1, 0});
    for (const std::size_t size : sizes) {
        random.add_mesh(size, -1, 0);
        random.add_mesh(size, -1, 4);
        random.add_mesh(size, 0, 0);
        random.add_mesh(size, 1, 3);
    }
    return std::move(random.scene);
}

TEST_F(PoseVertices, AreWhereTheHostPlacesThem) {
    expect_as_by_host(open(), scene_of({}, {0, 1, 3, 511, 512, 513, 2049}), 100);
}

TEST_F(PoseVertices, AreManyInOneMesh) {
    RandomScene random({});
    random.add_mesh(100'003, -1, 1);
    expect_as_by_host(open(), random.scene, 100);
}

TEST_F(PoseVertices, AreExactWhereTheirTermsCancel) {
    // An ULP of the coordinates in object space is 1/16 and 8.
    expect_as_by_host(open(), scene_of({.off = 1e6}, {100}), 1e8, 0.05);
    expect_as_by_host(open(), scene_of({.off = 1e8}, {100}), 1e10, 0.5);
}

TEST_F(PoseVertices, MayBeFarAwayTinyOrHuge) {
    expect_as_by_host(open(), scene_of({.translation = 1e9}, {100}), 1e11);
    expect_as_by_host(open(), scene_of({.scale = 1e-12, .translation = 1e-12}, {100}), 1e-10);
    expect_as_by_host(open(), scene_of({.scale = 1e12, .translation = 1e12}, {100}), 1e14);
    expect_as_by_host(open(),
                      scene_of({.object = 1e-9, .scale = 1e-9, .translation = 1e-18}, {100}), 1e-8);
}

TEST_F(PoseVertices, OfNoMeshTakeNoDevice) {
    Scene scene;
    MovingMeshes meshes(open(), scene);
    EXPECT_TRUE(meshes.empty());
    EXPECT_TRUE(meshes.moved_by(scene, meshes.pose_of(scene)).empty());
}

TEST_F(PoseVertices, MirroredOnesFaceTheSameWay) {
    // A mirrored unit vector and its normal, by a node and by a joint.
    Scene scene;
    scene.seconds = 0;
    scene.motion.nodes.resize(1);
    scene.motion.nodes[0].rest.scale = {-2, 1, 1};
    scene.motion.skins.push_back({.joints = {0}, .joint_from_mesh = {glm::dmat4(1)}});
    for (const int skin : {-1, 0}) {
        MovingMesh mesh{.skin = skin, .first_vertex = scene.positions.size()};
        mesh.positions = {{1, 0, 0}, {0, 1, 0}};
        mesh.normals = {{1, 0, 0}, {0.6f, 0.8f, 0}};
        if (skin >= 0) {
            mesh.joint_weights.resize(2, {{0, 0, 0, 0}, {1, 0, 0, 0}});
        }
        scene.positions.resize(scene.positions.size() + 2);
        scene.normals.resize(scene.positions.size());
        scene.motion.meshes.push_back(mesh);
    }
    MovingMeshes meshes(open(), scene);
    const Placed placed = placed_by(open(), scene, meshes);
    for (const std::size_t first : {0u, 2u}) {
        EXPECT_EQ(placed.positions[first], glm::vec4(-2, 0, 0, 0));
        EXPECT_EQ(placed.positions[first + 1], glm::vec4(0, 1, 0, 0));
        EXPECT_EQ(placed.normals[first], glm::vec4(-1, 0, 0, 0));
        const glm::vec4 expected(glm::normalize(glm::vec3(-0.3f, 0.8f, 0)), 0);
        EXPECT_NEAR(glm::distance(placed.normals[first + 1], expected), 0, 2e-7);
    }
}

TEST_F(PoseVertices, ThatAreNotFiniteAreRefused) {
    RandomScene random({.scale = 1e39});
    random.add_mesh(3, -1, 0);
    MovingMeshes meshes(open(), random.scene);
    placed_by(open(), random.scene, meshes);
    try {
        meshes.boxes(random.scene);
        FAIL();
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(), "posing 'random': a vertex of mesh has a position that is not "
                                   "finite in world space");
    }
}

} // namespace
} // namespace argand
