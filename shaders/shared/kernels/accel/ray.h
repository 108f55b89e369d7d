// A ray on its way through a tree.
struct Ray {
    vec3 origin;
    RayShear shear;
    vec3 inverse;     // of the direction; finite
    vec3 near_origin; // origin, moved to enlarge boxes: for sides that face it,
    vec3 far_origin;  // and for all others
    bvec3 backwards;
};

// The shear of intersect_triangle moves vertices by up to 6 roundings of the reach. So it may hit a
// triangle whose box the ray misses by that much, and miss the neighbour. Boxes are therefore
// enlarged by slightly more, which also covers the rounding of the grids' planes, at most twice as
// far away as the scene's sides. This decides about rays in the plane of a box's side, too.
FN Ray make_ray(vec3 origin, vec3 direction, vec3 low, vec3 high) {
    Ray ray;
    ray.origin = origin;
    ray.shear = ray_shear(direction);
    vec3 size = abs(direction);
    real least =
        max_component(size) * real(1e-18); // smaller components do not matter in single precision
    vec3 safe = mix(direction, vec3(least), lessThan(size, vec3(least)));
    ray.inverse = real(1.0) / safe;
    ray.backwards = lessThan(ray.inverse, vec3(real(0.0)));
    vec3 margin =
        abs(origin) * error_bound(4) + vec3(box_reach(origin, low, high) * error_bound(24));
    margin = mix(margin, -margin, ray.backwards);
    ray.near_origin = origin + margin;
    ray.far_origin = origin - margin;
    return ray;
}
