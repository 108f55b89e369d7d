// Normal textures. Include textures.h before.

FN uint normal_texture_of(uint material_textures) {
    return (material_textures & material_texture_mask) +
           ((material_textures & material_base_color_texture) != 0u ? 1u : 0u) +
           ((material_textures & material_metal_texture) != 0u ? 1u : 0u) +
           ((material_textures & material_emissive_texture) != 0u ? 1u : 0u);
}

FN bool has_normal_texture(uint material_textures) {
    return normal_maps && (material_textures & material_normal_texture) != 0u;
}

// The direction along `slope` in the frame of tangent, bitangent and normal at a hit. normal: unit,
// on the triangle's front. A flat slope keeps it and needs no tangents.
FN vec3 along_tangents(HitRecord hit, vec3 normal, vec3 slope) {
    if (slope.x == real(0.0) && slope.y == real(0.0)) {
        return normal;
    }
    uint at = scene[0].first_tangent + 2u * hit.triangle;
    uvec2 first = attributes[at];
    uvec3 tangents = uvec3(first.x, first.y, attributes[at + 1u].x);
    uvec4 triangle = triangles[hit.triangle];
    vec3 edge = vec3(positions[triangle.y]) - vec3(positions[triangle.x]);
    return from_tangents(normal, edge, tangents, vec2(hit.u, hit.v), slope);
}

// The normal between those of the vertices, on the side of the geometric normal `front`.
FN vec3 normal_on_front(HitRecord hit, vec3 front) {
    if (!smooth_normals) {
        return front;
    }
    uvec4 triangle = triangles[hit.triangle];
    vec3 n = vec3(normals[triangle.x]) * (real(1.0) - hit.u - hit.v) +
             vec3(normals[triangle.y]) * hit.u + vec3(normals[triangle.z]) * hit.v;
    vec3 normal = normalize_or(n, front);
    return dot3(normal, front) < real(0.0) ? -normal : normal;
}

// The normal along a texel's `slope`, on the side of the surface that the ray sees.
FN vec3 normal_of_slope(HitRecord hit, IN(Surface) s, vec3 slope) {
    vec3 front = s.front ? s.geometric_normal : -s.geometric_normal;
    vec3 normal = along_tangents(hit, normal_on_front(hit, front), slope);
    normal = normal_above(normal, front);
    return s.front ? normal : -normal;
}

// Turns a surface's shading normal by the texel at its hit. Unlike an interpolated normal it may
// face away from where the ray came from: what follows from that is the same for photons and eye
// paths, see docs/materials.md.
FN void turn_normal(uint material_textures, HitRecord hit, vec3 ray_direction, INOUT(Surface) s) {
    if (!has_normal_texture(material_textures)) {
        return;
    }
    uvec4 triangle = triangles[hit.triangle];
    vec2 b = vec2(hit.u, hit.v);
    uint index = normal_texture_of(material_textures);
    vec3 slope = slope_of_texel(sample_texture(index, triangle, b), real(textures[index].scale));
    s.shading_normal = normal_of_slope(hit, s, slope);
    s.above_horizon = dot3(s.shading_normal, ray_direction) < real(0.0);
}

// Where a texture has turned the normal away from an eye or a photon, they see the surface as from
// the mirrored direction, above the horizon. toward: where the ray came from.
FN vec3 toward_above(IN(Surface) s, vec3 toward) {
    real below = normal_maps ? min(dot3(s.shading_normal, toward), real(0.0)) : real(0.0);
    return toward - s.shading_normal * (real(2.0) * below);
}
