// Traversal of a TriangleBvh's tree with a stack, nearest boxes first, one ray per invocation.
// Included by trace_closest.h and trace_any.h, which declare load_result and store_result and
// define ANY_HIT as 0 or 1. NODES(i) and TRIANGLES(i) read the tree.
#include "shared/kernels/count.h"

struct Ray {
    vec3 origin;
    RayShear shear;
    vec3 inverse;     // of the direction, finite
    vec3 near_origin; // the origin moved such that boxes seem larger: for their sides that face it,
    vec3 far_origin;  // and for the others
    bvec3 backwards;
};

// The shear of intersect_triangle moves vertices by up to 6 roundings of the reach, so that it may
// find a triangle whose box the ray misses by that much, and not find the neighbour. Boxes are
// therefore met as if they were larger by a little more, with room also for the rounding of the
// grids' planes, which are at most twice as far away as the scene's sides. This also decides about
// rays that run in the very plane of a box's side.
FN Ray make_ray(vec3 origin, vec3 direction, vec3 low, vec3 high) {
    Ray ray;
    ray.origin = origin;
    ray.shear = ray_shear(direction);
    vec3 size = abs(direction);
    real least = max_component(size) *
                 real(1e-18); // below, a component does not matter within single precision
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

CONSTANT uint missed = 0xffffffffu;

FN vec4 cells(uint bytes) {
    return vec4(ivec4(bytes & 255u, (bytes >> 8u) & 255u, (bytes >> 16u) & 255u, bytes >> 24u));
}

// The children that the ray meets before t_max, nearest first: their numbers in the lowest two bits
// of where they are entered, or `missed`.
FN uvec4 meet_children(Ray ray, uvec4 a, uvec4 b, uvec2 c, real t_max) {
    vec3 low = bits_float(uvec3(a));
    vec3 scale = bits_float((uvec3(a.w, a.w >> 8u, a.w >> 16u) & 255u) << 23u) * ray.inverse;
    vec3 near_start = (low - ray.near_origin) * ray.inverse;
    vec3 far_start = (low - ray.far_origin) * ray.inverse;
    uvec3 low_cells = uvec3(b);
    uvec3 high_cells = uvec3(b.w, c);
    uvec3 near_cells = mix(low_cells, high_cells, ray.backwards);
    uvec3 far_cells = mix(high_cells, low_cells, ray.backwards);
    vec4 enter = max(max(cells(near_cells.x) * scale.x + near_start.x,
                         cells(near_cells.y) * scale.y + near_start.y),
                     max(cells(near_cells.z) * scale.z + near_start.z, vec4(real(0.0))));
    vec4 leave = min(
        min(cells(far_cells.x) * scale.x + far_start.x, cells(far_cells.y) * scale.y + far_start.y),
        min(cells(far_cells.z) * scale.z + far_start.z, vec4(t_max)));
    uint count = a.w >> 24u;
    bvec4 met = lessThanEqual(enter, leave);
    met.z = met.z && count > 2u;
    met.w = met.w && count > 3u;
    uvec4 keys = mix(uvec4(missed), (float_bits(enter) & ~3u) | uvec4(0u, 1u, 2u, 3u), met);
    uint low_left = min(keys.x, keys.y);
    uint high_left = max(keys.x, keys.y);
    uint low_right = min(keys.z, keys.w);
    uint high_right = max(keys.z, keys.w);
    uint second = max(low_left, low_right);
    uint third = min(high_left, high_right);
    return uvec4(min(low_left, low_right), min(second, third), max(second, third),
                 max(high_left, high_right));
}

FN void main() {
    uint thread = THREAD_INDEX;
    uint slot = 0u;
    uint ray_index;
    uint node = params.root;
    uint siblings = 0u; // that wait beside the node: see ray_stack_size
    uint stack[ray_stack_size + 1u];
    uint height = 0u;
    if (resume) {
        if (thread >= min(suspended[0], params.slot_count)) {
            return;
        }
        slot = suspended_head + thread * suspended_stride;
        ray_index = suspended[slot];
        node = suspended[slot + 1u];
        siblings = suspended[slot + 2u];
        height = suspended[slot + 3u];
        if (node == lbvh_end) {
            return;
        }
        for (uint i = 0u; i < height; ++i) {
            stack[i] = suspended[slot + 4u + i];
        }
    } else {
        uint i = params.first + thread;
        if (i >= ELEMENT_COUNT) {
            return;
        }
        ray_index = active_rays[i];
    }
    vec4 origin = rays[2u * ray_index];
    vec3 direction = vec3(rays[2u * ray_index + 1u]);
    uvec4 all = NODES(0u);
    vec3 low = bits_float(uvec3(all));
    vec3 high =
        low + real(255.0) * bits_float((uvec3(all.w, all.w >> 8u, all.w >> 16u) & 255u) << 23u);
    Ray ray = make_ray(vec3(origin), direction, low, high);
    HitRecord hit = HitRecord(no_triangle, origin.w, real(0.0), real(0.0));
    if (resume) {
        load_result(ray_index, hit);
    }
    if (!(origin.w >= real(0.0))) {
        node = lbvh_end;
    }

    uint steps_left = params.step_limit;
    while (node != lbvh_end && steps_left > 0u) {
        --steps_left;
        bool pop = true;
        bool push = false;
        uint next_siblings = siblings;
        bool inner = (node & 1u) == 0u;
        // CPUs that emulate lanes read for those too that do not take a branch: let that be what is
        // in the cache.
        uint place = inner ? 2u * node : 0u;
        uint triangle_place = inner ? 0u : 3u * (node >> 1u);
        if (inner) {
            uvec4 met = meet_children(ray, NODES(place), NODES(place + 1u),
                                      uvec2(NODES(place + 2u)), hit.t);
            uvec4 children = NODES(place + 3u);
            if (met.x != missed) {
                pop = false;
                if (met.y != missed) {
                    push = (siblings & 3u) != 0u;
                    next_siblings = (node << 7u) | ((met.y & 3u) << 2u) | ((met.z & 3u) << 4u) |
                                    ((met.w & 3u) << 6u) |
                                    (met.w != missed ? 3u : (met.z != missed ? 2u : 1u));
                }
                uint first = met.x & 3u;
                node = first < 2u ? (first == 0u ? children.x : children.y)
                                  : (first == 2u ? children.z : children.w);
            }
        } else {
            vec4 a = TRIANGLES(triangle_place);
            vec3 b = vec3(TRIANGLES(triangle_place + 1u));
            vec3 c = vec3(TRIANGLES(triangle_place + 2u));
            real t, u, v;
            if (intersect_triangle(ray.shear, ray.origin, vec3(a), b, c, real(0.0), hit.t, t, u,
                                   v)) {
                // Of triangles at one distance the first in the scene counts, whatever the order of
                // traversal.
                uint triangle = float_bits(a.w);
                if (t < hit.t || triangle < hit.triangle) {
                    hit = HitRecord(triangle, t, u, v);
                }
                if (ANY_HIT != 0) {
                    next_siblings = 0u;
                    height = 0u;
                }
            }
        }
        // Written whether or not it counts: CPUs that emulate lanes mispredict what only some of
        // them write.
        stack[height] = siblings;
        height += push ? 1u : 0u;
        siblings = next_siblings;
        if (pop) {
            node = lbvh_end;
            if ((siblings & 3u) == 0u && height > 0u) {
                --height;
                siblings = stack[height];
            }
            bool more = (siblings & 3u) != 0u;
            uint from = more ? 4u * (siblings >> 8u) : place;
            if (more) {
                uvec4 children = NODES(from + 3u);
                uint which = (siblings >> 2u) & 3u;
                node = which < 2u ? (which == 0u ? children.x : children.y)
                                  : (which == 2u ? children.z : children.w);
                siblings = (siblings & ~255u) | ((siblings >> 2u) & 60u) | ((siblings & 3u) - 1u);
            }
        }
    }

    store_result(ray_index, hit);
    if (resume) {
        suspended[slot + 1u] = node;
    }
    if (node != lbvh_end) {
        if (!resume && params.last == 0u) {
            uint mine = atomicAdd(suspended[0], 1u);
            slot = mine < params.slot_count ? suspended_head + mine * suspended_stride : 0u;
        }
        if (slot == 0u || params.last != 0u) {
            atomicAdd(unfinished[0], 1u);
        } else {
            atomicAdd(suspended[1], 1u);
            suspended[slot] = ray_index;
            suspended[slot + 1u] = node;
            suspended[slot + 2u] = siblings;
            suspended[slot + 3u] = height;
            for (uint i = 0u; i < height; ++i) {
                suspended[slot + 4u + i] = stack[i];
            }
        }
    }
}
