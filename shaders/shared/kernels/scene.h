FN vec3 scene_center() { return vec3(scene[0].center_x, scene[0].center_y, scene[0].center_z); }

FN SmoothTriangle load_triangle(uint index) {
    uvec4 t = triangles[index];
    SmoothTriangle triangle;
    triangle.v0 = vec3(positions[t.x]);
    triangle.v1 = vec3(positions[t.y]);
    triangle.v2 = vec3(positions[t.z]);
    triangle.n0 = vec3(normals[t.x]);
    triangle.n1 = vec3(normals[t.y]);
    triangle.n2 = vec3(normals[t.z]);
    return triangle;
}

FN Surface load_surface(HitRecord hit, vec3 ray_direction) {
    if (!smooth_normals) {
        uvec4 t = triangles[hit.triangle];
        return make_flat_surface(vec3(positions[t.x]), vec3(positions[t.y]), vec3(positions[t.z]),
                                 hit.u, hit.v, ray_direction);
    }
    return make_surface(load_triangle(hit.triangle), hit.u, hit.v, ray_direction);
}

// Chooses a light in proportion to its weight (Walker 1977); u in [0,1). Returns its index.
FN uint choose_light(real u, OUT(real) probability) {
    if (!several_lights) {
        probability = real(1.0);
        return 0u;
    }
    real scaled = u * real(scene[0].light_count);
    uint row = min(uint(scaled), scene[0].light_count - 1u);
    LightChoice choice = light_choices[row];
    if (scaled - real(row) >= choice.keep) {
        row = choice.alias;
    }
    probability = light_choices[row].probability;
    return row;
}
