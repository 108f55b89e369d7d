FN bool same_place(uint a, uint b) {
    vec3 p = vec3(positions[a]);
    vec3 q = vec3(positions[b]);
    return p.x == q.x && p.y == q.y && p.z == q.z;
}

FN bool same_corners(uvec3 a, uvec3 b) {
    return same_place(a.x, b.x) && same_place(a.y, b.y) && same_place(a.z, b.z);
}

// Whether an earlier triangle of the scene has the same front.
FN bool is_duplicate(uint place) {
    uvec4 t = triangles[order[place]];
    for (uint k = place; k > 0u && hashes[k - 1u] == hashes[place]; --k) {
        uvec4 other = triangles[order[k - 1u]];
        if (same_corners(uvec3(t.x, t.y, t.z), uvec3(other.x, other.y, other.z)) ||
            same_corners(uvec3(t.x, t.y, t.z), uvec3(other.y, other.z, other.x)) ||
            same_corners(uvec3(t.x, t.y, t.z), uvec3(other.z, other.x, other.y))) {
            return true;
        }
    }
    return false;
}

// Takes the area from triangles on which no photon may lie: those of mirrors, glass and what is
// black, and duplicates with the same front, of which rays hit only the first.
FN void main() {
    uint place = THREAD_INDEX;
    if (place >= params.count) {
        return;
    }
    uint i = order[place];
    if (stores[triangles[i].w] == 0u || (areas[i].x > real(0.0) && is_duplicate(place))) {
        areas[i] = vec2(real(0.0), real(0.0));
    }
}
