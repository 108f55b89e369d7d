#include "world/pose_tables.hpp"

#include "base/same_bits.hpp"
#include "scene/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace argand {

namespace {

/// A range of matrices.
struct MatrixRange {
    std::size_t first, count;
};

MatrixRange matrices_of_skin(const Motion& motion, std::size_t skin) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < skin; ++i) {
        first += motion.skins[i].joints.size();
    }
    return {first, motion.skins[skin].joints.size()};
}

std::size_t first_matrix_of_nodes(const Motion& motion) {
    if (motion.skins.empty()) {
        return 0;
    }
    const MatrixRange last = matrices_of_skin(motion, motion.skins.size() - 1);
    return last.first + last.count;
}

MatrixRange matrices_of(const Motion& motion, const PoseTables& tables, std::size_t mesh) {
    const int skin = motion.meshes[mesh].skin;
    return skin >= 0 ? matrices_of_skin(motion, static_cast<std::size_t>(skin))
                     : MatrixRange{tables.meshes[mesh].matrix, 1};
}

void add_vertices(PoseTables& tables, const MovingMesh& mesh, std::uint32_t number) {
    tables.vertices.reserve(tables.vertices.size() + mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 &p = mesh.positions[v], &n = mesh.normals[v];
        tables.vertices.push_back({p.x, p.y, p.z, number, n.x, n.y, n.z, 0});
    }
}

void add_joints(PoseTables& tables, const Motion& motion, const MovingMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(
        matrices_of_skin(motion, static_cast<std::size_t>(mesh.skin)).first);
    tables.joints.reserve(tables.joints.size() + mesh.joint_weights.size());
    for (const JointWeights& by : mesh.joint_weights) {
        VertexJoints record{};
        for (int k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(k);
            record.matrices[k] = first + by.joints[i];
            record.weights[k] = by.weights[i];
        }
        tables.joints.push_back(record);
    }
}

void add_offsets(PoseTables& tables, const MovingMesh& mesh) {
    tables.offsets.reserve(tables.offsets.size() + mesh.targets.size() * mesh.positions.size());
    for (const MorphTarget& target : mesh.targets) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::vec3 p = target.positions.empty() ? glm::vec3(0) : target.positions[v];
            const glm::vec3 n = target.normals.empty() ? glm::vec3(0) : target.normals[v];
            tables.offsets.push_back({p.x, p.y, p.z, 0, n.x, n.y, n.z, 0});
        }
    }
}

void add_parts(PoseTables& tables, std::uint32_t number) {
    const PosedMesh& mesh = tables.meshes[number];
    for (std::uint32_t done = 0; done < mesh.vertices; done += most_vertices_of_part) {
        tables.parts.push_back({number, mesh.first_vertex + done, mesh.first_moving_vertex + done,
                                std::min(mesh.vertices - done, most_vertices_of_part)});
    }
}

/// A number as a sum of two of single precision. Devices may take numbers below the smallest normal
/// one for 0, so that none is given to them.
struct Split {
    float high, low;
};

float normal_or_zero(double x) {
    return std::abs(x) < double(std::numeric_limits<float>::min()) ? 0 : static_cast<float>(x);
}

Split split(double x) {
    const float high = normal_or_zero(x);
    return {high, normal_or_zero(x - double(high))};
}

PoseMatrix record_of(const glm::dmat4& to_world) {
    PoseMatrix record{};
    const std::array<lane4*, 3> high{&record.high_x, &record.high_y, &record.high_z};
    const std::array<lane4*, 3> low{&record.low_x, &record.low_y, &record.low_z};
    const std::array<lane4*, 3> normal{&record.normal_x, &record.normal_y, &record.normal_z};
    const glm::dmat3 of_normals = vertex_transform(to_world).normal;
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(of_normals[column][row]));
        }
    }
    const double scale = largest > 0 ? 1 / largest : 0;
    for (int row = 0; row < 3; ++row) {
        const auto r = static_cast<std::size_t>(row);
        for (int column = 0; column < 4; ++column) {
            const Split value = split(to_world[column][row]);
            (*high[r])[column] = value.high;
            (*low[r])[column] = value.low;
            if (column < 3) {
                (*normal[r])[column] = normal_or_zero(scale * of_normals[column][row]);
            }
        }
    }
    return record;
}

template <class Record>
bool differ(const std::vector<Record>& a, const std::vector<Record>& b, std::size_t first,
            std::size_t count) {
    const auto begin = static_cast<std::ptrdiff_t>(first);
    return !std::equal(a.begin() + begin, a.begin() + begin + static_cast<std::ptrdiff_t>(count),
                       b.begin() + begin, have_same_bits<Record>);
}

} // namespace

PoseTables pose_tables(const Scene& scene) {
    const Motion& motion = scene.motion;
    PoseTables tables;
    tables.meshes.reserve(motion.meshes.size());
    const std::size_t first_of_nodes = first_matrix_of_nodes(motion);
    std::unordered_map<std::uint32_t, std::uint32_t> matrix_of_node;
    std::size_t weights = 0;
    for (const MovingMesh& mesh : motion.meshes) {
        const auto number = static_cast<std::uint32_t>(tables.meshes.size());
        PosedMesh record{};
        record.first_vertex = static_cast<std::uint32_t>(mesh.first_vertex);
        record.first_moving_vertex = static_cast<std::uint32_t>(tables.vertices.size());
        record.vertices = static_cast<std::uint32_t>(mesh.positions.size());
        record.first_joints = no_joints;
        if (mesh.skin >= 0) {
            record.first_joints = static_cast<std::uint32_t>(tables.joints.size());
            add_joints(tables, motion, mesh);
        } else {
            const auto [found, is_new] = matrix_of_node.try_emplace(
                mesh.node, static_cast<std::uint32_t>(first_of_nodes + tables.nodes.size()));
            if (is_new) {
                tables.nodes.push_back(mesh.node);
            }
            record.matrix = found->second;
        }
        record.first_weight = static_cast<std::uint32_t>(weights);
        record.targets = static_cast<std::uint32_t>(mesh.targets.size());
        record.first_offset = static_cast<std::uint32_t>(tables.offsets.size());
        weights += mesh.targets.size();
        add_vertices(tables, mesh, number);
        add_offsets(tables, mesh);
        tables.meshes.push_back(record);
        add_parts(tables, number);
        for (std::size_t t = 0; t < mesh.triangles; ++t) {
            const glm::uvec3& corners = scene.triangles[mesh.first_triangle + t];
            for (int k = 0; k < 3; ++k) {
                tables.vertices[record.first_moving_vertex + corners[k] - record.first_vertex]
                    .is_used = 1;
            }
        }
    }
    return tables;
}

PoseRecords pose_records(const Motion& motion, const PoseTables& tables, const Pose& pose) {
    PoseRecords records;
    records.matrices.reserve(first_matrix_of_nodes(motion) + tables.nodes.size());
    for (const Skin& skin : motion.skins) {
        for (const glm::dmat4& to_world : joint_transforms(skin, pose)) {
            records.matrices.push_back(record_of(to_world));
        }
    }
    for (const std::uint32_t node : tables.nodes) {
        records.matrices.push_back(record_of(pose.world_from_node[node]));
    }
    for (const MovingMesh& mesh : motion.meshes) {
        for (std::size_t t = 0; t < mesh.targets.size(); ++t) {
            const Split weight = split(pose.morph_weights[mesh.node][t]);
            records.weights.push_back({weight.high, weight.low});
        }
    }
    return records;
}

bool has_moved(const Motion& motion, const PoseTables& tables, std::size_t mesh,
               const PoseRecords& before, const PoseRecords& now) {
    const MatrixRange range = matrices_of(motion, tables, mesh);
    const PosedMesh& record = tables.meshes[mesh];
    return differ(before.matrices, now.matrices, range.first, range.count) ||
           differ(before.weights, now.weights, record.first_weight, record.targets);
}

} // namespace argand
