// Traverses a kd-tree with a stack, nearest cells first, one ray per invocation. Included by
// kd_any.h and kd_closest.h, after functions, ANY_HIT and ALPHA as for traverse.h.
#include "shared/kernels/accel/ray.h"
#if ALPHA
#include "shared/kernels/accel/meet_alpha.h"
#else
#include "shared/kernels/accel/meet_triangle.h"
#endif
#include "shared/kernels/accel/suspended_slot.h"
#include "shared/kernels/count.h"

// Position of a ray in the tree, without its stack: the next node, or the elements of a leaf that
// are left, and the part of the ray in its cell.
struct Walk {
    uint ray;
    uint node; // lbvh_end: done
    uint at, end;
    real enter, leave;
    uint height; // of the stack
};

FN Walk new_walk(uint ray) {
    Walk walk;
    walk.ray = ray;
    walk.node = params.root;
    walk.at = 0u;
    walk.end = 0u;
    walk.enter = real(0.0);
    walk.leave = real(0.0);
    walk.height = 0u;
    return walk;
}

FN Walk suspended_walk(uint slot) {
    Walk walk;
    walk.ray = suspended[slot];
    walk.node = suspended[slot + 1u];
    walk.at = suspended[slot + 2u];
    walk.end = suspended[slot + 3u];
    walk.enter = bits_float(suspended[slot + 4u]);
    walk.leave = bits_float(suspended[slot + 5u]);
    walk.height = suspended[slot + 6u];
    return walk;
}

// Counts an unfinished ray and saves its position, without its stack. slot: the ray's slot, or 0.
// Returns the slot, or 0 if there is none.
FN uint suspend(Walk walk, uint slot) {
    slot = slot_to_suspend(slot, kd_suspended_stride);
    if (slot != 0u) {
        suspended[slot] = walk.ray;
        suspended[slot + 1u] = walk.node;
        suspended[slot + 2u] = walk.at;
        suspended[slot + 3u] = walk.end;
        suspended[slot + 4u] = float_bits(walk.enter);
        suspended[slot + 5u] = float_bits(walk.leave);
        suspended[slot + 6u] = walk.height;
    }
    return slot;
}

// Finds the part of the ray in the root's cell, which is enlarged as every other.
FN void enter_root(Ray ray, vec3 low, vec3 high, real t_max, INOUT(Walk) walk) {
    vec3 enter = (mix(low, high, ray.backwards) - ray.near_origin) * ray.inverse;
    vec3 leave = (mix(high, low, ray.backwards) - ray.far_origin) * ray.inverse;
    walk.enter = max(max_component(enter), real(0.0));
    walk.leave = min(min(leave.x, min(leave.y, leave.z)), t_max);
    if (!(walk.enter <= walk.leave)) {
        walk.node = lbvh_end;
    }
}

#if ALPHA && ANY_HIT
// Rays meet a triangle in each cell that it crosses, but must count it once. So they look for the
// closest surface, add its thickness, and begin anew for the closest one behind it.
FN void load_layer(uint from, OUT(HitRecord) hit) {
    hit = HitRecord(suspended[from], bits_float(suspended[from + 1u]),
                    bits_float(suspended[from + 2u]), bits_float(suspended[from + 3u]));
}

FN void store_layer(uint to, HitRecord hit) {
    suspended[to] = hit.triangle;
    suspended[to + 1u] = float_bits(hit.t);
    suspended[to + 2u] = float_bits(hit.u);
    suspended[to + 3u] = float_bits(hit.v);
}
#endif

// One function, for GLSL would copy the stack to any other.
// NOLINTNEXTLINE(readability-function-size)
FN void main() {
    uint thread = THREAD_INDEX;
    uint slot = 0u;
    Walk walk;
    uvec3 stack[kd_most_depth + 1u]; // node, and the part of the ray in its cell
    if (resume) {
        if (thread >= min(suspended[0], params.slot_count)) {
            return;
        }
        slot = suspended_head + thread * kd_suspended_stride;
        walk = suspended_walk(slot);
        if (walk.node == lbvh_end) {
            return;
        }
        for (uint i = 0u; i < walk.height; ++i) {
            uint from = slot + kd_suspended_words + 3u * i;
            stack[i] = uvec3(suspended[from], suspended[from + 1u], suspended[from + 2u]);
        }
    } else {
        uint i = params.first + thread;
        if (i >= ELEMENT_COUNT) {
            return;
        }
        walk = new_walk(active_rays[i]);
    }
    vec4 origin = rays[2u * walk.ray];
    uint root = kd_node_index(words[0]);
    vec3 low = vec3(boxes[2u * root]);
    vec3 high = vec3(boxes[2u * root + 1u]);
    Ray ray = make_ray(vec3(origin), vec3(rays[2u * walk.ray + 1u]), low, high);
    HitRecord hit = HitRecord(no_triangle, origin.w, real(0.0), real(0.0));
#if ALPHA
    HitRecord passed = nothing_passed();
    if (resume) {
        load_passed(slot + kd_suspended_passed, passed);
    }
#endif
#if ALPHA && ANY_HIT
    HitRecord layers = HitRecord(0u, origin.w, real(0.0), real(0.0));
#define RESULT layers
#else
#define RESULT hit
#endif
#if ALPHA && !ANY_HIT
    if (!resume && goes_on_behind_hit(origin.w)) {
        load_result(walk.ray, passed);
        hit.t = far_away;
    }
#endif
    if (resume) {
        load_result(walk.ray, RESULT);
#if ALPHA && ANY_HIT
        load_layer(slot + kd_suspended_layer, hit);
#endif
    } else if (walk.node != lbvh_end) {
        enter_root(ray, low, high, hit.t, walk);
    }
    if (!(origin.w >= real(0.0))) {
        walk.node = lbvh_end;
    }

    uint steps_left = params.step_limit;
    while (walk.node != lbvh_end && steps_left > 0u) {
        --steps_left;
        bool pop = false;
        if (walk.at < walk.end) {
#if ALPHA
            bool met = meet_triangle(ray, 3u * words[walk.at], passed, hit);
#else
            bool met = meet_triangle(ray, 3u * words[walk.at], hit);
#endif
            ++walk.at;
            if (met && ANY_HIT != 0) {
                walk.at = walk.end;
                walk.height = 0u;
            }
            pop = walk.at >= walk.end;
        } else {
            uint second = words[walk.node + 1u];
            if (kd_is_leaf(words[walk.node])) {
                walk.at = walk.node + kd_leaf_words;
                walk.end = walk.at + second;
                pop = second == 0u;
            } else {
                // Each child's cell is enlarged over the plane: the ray enters the far one early,
                // and leaves the near one late.
                uint axis = kd_axis(second);
                real split = bits_float(words[walk.node + 2u]);
                real inverse = kd_at(ray.inverse, axis);
                real early = (split - kd_at(ray.near_origin, axis)) * inverse;
                real late = (split - kd_at(ray.far_origin, axis)) * inverse;
                uint left = kd_left_child(walk.node);
                uint right = kd_right_child(second);
                uint near = inverse < real(0.0) ? right : left;
                uint far = inverse < real(0.0) ? left : right;
                bool to_near = walk.enter <= late;
                bool to_far = early <= min(walk.leave, hit.t);
                real enter_far = max(walk.enter, early);
                // Written even if not needed, as in traverse.h.
                stack[walk.height] = uvec3(far, float_bits(enter_far), float_bits(walk.leave));
                walk.height += to_near && to_far ? 1u : 0u;
                walk.node = to_near ? near : far;
                walk.enter = to_near ? walk.enter : enter_far;
                walk.leave = to_near ? min(walk.leave, late) : walk.leave;
                pop = !to_near && !to_far;
            }
        }
        if (pop) {
            walk.node = lbvh_end;
            // Cells behind the hit are left out; at one distance another triangle may count.
            while (walk.height > 0u && walk.node == lbvh_end) {
                --walk.height;
                uvec3 top = stack[walk.height];
                walk.enter = bits_float(top.y);
                walk.leave = bits_float(top.z);
                walk.node = walk.enter <= hit.t ? top.x : lbvh_end;
            }
        }
#if ALPHA && ANY_HIT
        if (walk.node == lbvh_end && hit.triangle != no_triangle) {
            real coverage = coverage_at(corners[hit.triangle], vec2(hit.u, hit.v));
            layers.triangle = add_thickness(layers.triangle, thickness_of(coverage));
            if (layers.triangle != thickness_of_all) {
                passed = hit;
                hit = HitRecord(no_triangle, origin.w, real(0.0), real(0.0));
                walk = new_walk(walk.ray);
                enter_root(ray, low, high, origin.w, walk);
            }
        }
#endif
    }

    store_result(walk.ray, RESULT);
    if (resume) {
        suspended[slot + 1u] = walk.node;
    }
    if (walk.node != lbvh_end) {
        slot = suspend(walk, slot);
#if ALPHA
        if (slot != 0u) {
            store_passed(slot + kd_suspended_passed, passed);
        }
#endif
#if ALPHA && ANY_HIT
        if (slot != 0u) {
            store_layer(slot + kd_suspended_layer, hit);
        }
#endif
        for (uint i = 0u; slot != 0u && i < walk.height; ++i) {
            uint to = slot + kd_suspended_words + 3u * i;
            suspended[to] = stack[i].x;
            suspended[to + 1u] = stack[i].y;
            suspended[to + 2u] = stack[i].z;
        }
    }
}
#undef RESULT
