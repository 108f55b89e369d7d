struct ObjectVertex {
    PrecisePoint position;
    vec3 normal;
};

FN ObjectVertex morphed(IN(MovingVertex) vertex, IN(PosedMesh) mesh, uint in_mesh) {
    ObjectVertex result;
    result.position = precise_point(vec3(vertex.x, vertex.y, vertex.z));
    result.normal = vec3(vertex.normal_x, vertex.normal_y, vertex.normal_z);
    for (uint t = 0u; t < mesh.targets; ++t) {
        MorphWeight weight = weights[mesh.first_weight + t];
        if (weight.high != real(0.0)) {
            MorphOffset by = offsets[mesh.first_offset + t * mesh.vertices + in_mesh];
            add_weighted(result.position, weight, vec3(by.x, by.y, by.z));
            result.normal += weight.high * vec3(by.normal_x, by.normal_y, by.normal_z);
        }
    }
    return result;
}

// Places a vertex of a moving mesh in world space.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.vertices) {
        return;
    }
    MovingVertex vertex = vertices[i];
    PosedMesh mesh = meshes[vertex.mesh];
    uint in_mesh = i - mesh.first_moving_vertex;
    ObjectVertex from = morphed(vertex, mesh, in_mesh);
    PrecisePoint to = precise_point(vec3(real(0.0)));
    vec3 normal = vec3(real(0.0));
    if (mesh.first_joints == no_joints) {
        PoseMatrix by_node = matrices[mesh.matrix];
        to = transformed(by_node, from.position);
        normal = transformed_normal(by_node, from.normal);
    } else {
        VertexJoints by = joints[mesh.first_joints + in_mesh];
        BlendedRows rows;
        rows.x = vec3(real(0.0));
        rows.y = rows.x;
        rows.z = rows.x;
        for (uint k = 0u; k < 4u; ++k) {
            if (by.weights[k] > real(0.0)) {
                PoseMatrix by_joint = matrices[by.matrices[k]];
                add_weighted(to, by.weights[k], transformed(by_joint, from.position));
                add_weighted(rows, by.weights[k], by_joint);
            }
        }
        normal = transformed_normal(rows, from.normal);
    }
    uint at = mesh.first_vertex + in_mesh;
    positions[at] = vec4(to.high + to.low, real(0.0));
    if (params.with_normals != 0u) {
        normals[at] = vec4(normal, real(0.0));
    }
}
