// The weights of the second and third vertex at the point of a triangle's plane in a direction from
// the origin, moved into the triangle.
FN vec2 weights_toward(vec3 direction, vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross3(ab, ac);
    vec3 p = direction * (dot3(normal, a) / dot3(normal, direction)) - a;
    real size = dot3(normal, normal);
    vec2 weights = vec2(dot3(cross3(p, ac), normal), dot3(cross3(ab, p), normal)) / size;
    if (!is_finite(weights.x) || !is_finite(weights.y)) {
        return vec2(real(0.33333333333333333333));
    }
    weights = max(weights, vec2(real(0.0)));
    return weights / max(weights.x + weights.y, real(1.0));
}
