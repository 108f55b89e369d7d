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

// A light that was chosen at random.
struct ChosenLight {
    uint index;
    real probability;
    real emitter_probability; // of all lights that belong to the same emitter
};

// Chooses a light for a shadow ray or for a photon; u in [0,1)². The second number continues the
// digits of the first, of which there are too few for lights that are chosen rarely.
FN ChosenLight choose_light(vec2 u, bool for_photon) {
    ChosenLight chosen;
    chosen.index = 0u;
    chosen.probability = real(1.0);
    chosen.emitter_probability = real(1.0);
    if (!several_lights) {
        return chosen;
    }
    uint count = scene[0].light_count;
    uint table = for_photon ? count : 0u;
    uint digits = uint(u.x * real(16777216.0)) << 8u | uint(u.y * real(256.0));
    uint first = 0u;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (light_choices[table + first + half_count].before <= digits) {
            first += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    chosen.index = first;
    LightChoice choice = light_choices[table + first];
    chosen.probability = choice.probability;
    chosen.emitter_probability = choice.emitter_probability;
    return chosen;
}
