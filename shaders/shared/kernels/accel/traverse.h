// Traverses a TriangleBvh's tree with a stack, nearest boxes first, one ray per invocation.
// Included by trace_closest.h and trace_any.h, which declare load_result and store_result and
// define ANY_HIT and ALPHA as 0 or 1. NODES(i) and TRIANGLES(i) read the tree.
#include "shared/kernels/accel/ray.h"
#if ALPHA
#include "shared/kernels/accel/meet_alpha.h"
#else
#include "shared/kernels/accel/meet_triangle.h"
#endif
#include "shared/kernels/accel/suspended_slot.h"
#include "shared/kernels/count.h"

CONSTANT uint missed = 0xffffffffu;

FN vec4 cells(uint bytes) {
    return vec4(ivec4(bytes & 255u, (bytes >> 8u) & 255u, (bytes >> 16u) & 255u, bytes >> 24u));
}

// The children that the ray enters before t_max, nearest first: the child's number in the lowest
// two bits of the entry distance, or `missed`.
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

// Position of a ray in the tree, without its stack.
struct Walk {
    uint ray;
    uint node;     // lbvh_end: done
    uint siblings; // children that wait beside the node: see ray_stack_size
    uint height;   // of the stack
};

FN Walk new_walk(uint ray) {
    Walk walk;
    walk.ray = ray;
    walk.node = params.root;
    walk.siblings = 0u;
    walk.height = 0u;
    return walk;
}

FN Walk suspended_walk(uint slot) {
    Walk walk;
    walk.ray = suspended[slot];
    walk.node = suspended[slot + 1u];
    walk.siblings = suspended[slot + 2u];
    walk.height = suspended[slot + 3u];
    return walk;
}

// Counts an unfinished ray and saves its position, without its stack. slot: the ray's slot, or 0.
// Returns the slot, or 0 if there is none.
FN uint suspend(Walk walk, uint slot) {
    slot = slot_to_suspend(slot, suspended_stride);
    if (slot != 0u) {
        suspended[slot] = walk.ray;
        suspended[slot + 1u] = walk.node;
        suspended[slot + 2u] = walk.siblings;
        suspended[slot + 3u] = walk.height;
    }
    return slot;
}

FN Ray load_ray(vec4 origin, uint ray) {
    uvec4 all = NODES(0u);
    vec3 low = bits_float(uvec3(all));
    vec3 high =
        low + real(255.0) * bits_float((uvec3(all.w, all.w >> 8u, all.w >> 16u) & 255u) << 23u);
    return make_ray(vec3(origin), vec3(rays[2u * ray + 1u]), low, high);
}

FN uint child_at(uvec4 children, uint which) {
    return which < 2u ? (which == 0u ? children.x : children.y)
                      : (which == 2u ? children.z : children.w);
}

// Packs the children of a node that wait while the nearest is visited into one word; see
// ray_stack_size. met: from meet_children, at least two.
FN uint waiting_children(uint node, uvec4 met) {
    return (node << 7u) | ((met.y & 3u) << 2u) | ((met.z & 3u) << 4u) | ((met.w & 3u) << 6u) |
           (met.w != missed ? 3u : (met.z != missed ? 2u : 1u));
}

// Continues with the nearest of the children that wait beside the node; without one the ray is
// done. place: index of the node, to read something that is in the cache.
FN void next_sibling(INOUT(Walk) walk, uint place) {
    bool more = (walk.siblings & 3u) != 0u;
    uint from = more ? 4u * (walk.siblings >> 8u) : place;
    walk.node = lbvh_end;
    if (more) {
        uvec4 children = NODES(from + 3u);
        walk.node = child_at(children, (walk.siblings >> 2u) & 3u);
        walk.siblings =
            (walk.siblings & ~255u) | ((walk.siblings >> 2u) & 60u) | ((walk.siblings & 3u) - 1u);
    }
}

// One function, for GLSL would copy the stack to any other.
// NOLINTNEXTLINE(readability-function-size)
FN void main() {
    uint thread = THREAD_INDEX;
    uint slot = 0u;
    Walk walk;
    uint stack[ray_stack_size + 1u];
    if (resume) {
        if (thread >= min(suspended[0], params.slot_count)) {
            return;
        }
        slot = suspended_head + thread * suspended_stride;
        walk = suspended_walk(slot);
        if (walk.node == lbvh_end) {
            return;
        }
        for (uint i = 0u; i < walk.height; ++i) {
            stack[i] = suspended[slot + 4u + i];
        }
    } else {
        uint i = params.first + thread;
        if (i >= ELEMENT_COUNT) {
            return;
        }
        walk = new_walk(active_rays[i]);
    }
    vec4 origin = rays[2u * walk.ray];
    Ray ray = load_ray(origin, walk.ray);
    HitRecord hit = HitRecord(no_triangle, origin.w, real(0.0), real(0.0));
#if ALPHA && ANY_HIT
    hit.triangle = 0u;
#elif ALPHA
    HitRecord passed = nothing_passed();
    if (resume) {
        load_passed(slot + suspended_passed, passed);
    } else if (goes_on_behind_hit(origin.w)) {
        load_result(walk.ray, passed);
        hit.t = far_away;
    }
#endif
    if (resume) {
        load_result(walk.ray, hit);
    }
    if (!(origin.w >= real(0.0))) {
        walk.node = lbvh_end;
    }

    uint steps_left = params.step_limit;
    while (walk.node != lbvh_end && steps_left > 0u) {
        --steps_left;
        bool pop = true;
        bool push = false;
        uint next_siblings = walk.siblings;
        bool inner = (walk.node & 1u) == 0u;
        // CPUs that emulate lanes also read for lanes that do not take a branch: let them read what
        // is in the cache.
        uint place = inner ? 2u * walk.node : 0u;
        uint triangle_place = inner ? 0u : 3u * (walk.node >> 1u);
        if (inner) {
            uvec4 met = meet_children(ray, NODES(place), NODES(place + 1u),
                                      uvec2(NODES(place + 2u)), hit.t);
            uvec4 children = NODES(place + 3u);
            if (met.x != missed) {
                pop = false;
                if (met.y != missed) {
                    push = (walk.siblings & 3u) != 0u;
                    next_siblings = waiting_children(walk.node, met);
                }
                walk.node = child_at(children, met.x & 3u);
            }
        } else {
#if ALPHA && ANY_HIT
            bool ends = pass_triangle(ray, triangle_place, hit);
#elif ALPHA
            bool ends = false;
            meet_triangle(ray, triangle_place, passed, hit);
#else
            bool ends = meet_triangle(ray, triangle_place, hit) && ANY_HIT != 0;
#endif
            if (ends) {
                next_siblings = 0u;
                walk.height = 0u;
            }
        }
        // Written even if not needed: CPUs that emulate lanes mispredict writes by only some lanes.
        stack[walk.height] = walk.siblings;
        walk.height += push ? 1u : 0u;
        walk.siblings = next_siblings;
        if (pop) {
            if ((walk.siblings & 3u) == 0u && walk.height > 0u) {
                --walk.height;
                walk.siblings = stack[walk.height];
            }
            next_sibling(walk, place);
        }
    }

    store_result(walk.ray, hit);
    if (resume) {
        suspended[slot + 1u] = walk.node;
    }
    if (walk.node != lbvh_end) {
        slot = suspend(walk, slot);
#if ALPHA && !ANY_HIT
        if (slot != 0u) {
            store_passed(slot + suspended_passed, passed);
        }
#endif
        for (uint i = 0u; slot != 0u && i < walk.height; ++i) {
            suspended[slot + 4u + i] = stack[i];
        }
    }
}
