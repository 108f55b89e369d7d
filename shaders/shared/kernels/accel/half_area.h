CONSTANT real triangle_cost = real(0.5); // of testing a triangle, relative to a node

FN real half_area(vec3 low, vec3 high) {
    vec3 size = max(high - low, vec3(real(0.0)));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}
