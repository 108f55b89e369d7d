// Whether a comes before b in the order of their coordinates.
FN bool comes_before(vec3 a, vec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

FN uint bits_of(real x) { return x == real(0.0) ? 0u : float_bits(x); } // of 0 and -0 the same

FN uvec4 hashed(uvec4 bits) { return pcg4d(bits ^ (bits >> 16u)); }

// A number that triangles with the same corners in the same order have in common, whichever corner
// they begin with.
FN uint hash_of(vec3 a, vec3 b, vec3 c) {
    vec3 first = a;
    vec3 second = b;
    vec3 third = c;
    if (comes_before(b, first)) {
        first = b;
        second = c;
        third = a;
    }
    if (comes_before(c, first)) {
        first = c;
        second = a;
        third = b;
    }
    uvec4 h =
        hashed(uvec4(bits_of(first.x), bits_of(first.y), bits_of(first.z), bits_of(second.x)));
    h = hashed(h ^ uvec4(bits_of(second.y), bits_of(second.z), bits_of(third.x), bits_of(third.y)));
    return hashed(h ^ uvec4(bits_of(third.z), 0u, 0u, 0u)).x;
}

// Finds the area of a triangle, and the hash by which its duplicates are found.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uvec4 t = triangles[i];
    vec3 a = vec3(positions[t.x]);
    vec3 b = vec3(positions[t.y]);
    vec3 c = vec3(positions[t.z]);
    vec2 area = precise_triangle_area(a, b, c);
    areas[i] = area;
    // Triangles that shrank to one point are no one's duplicates, and need not be told apart.
    hashes[i] = area.x > real(0.0) ? hash_of(a, b, c) : i;
    order[i] = i;
}
