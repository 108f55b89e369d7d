// Traversal of a TriangleBvh's tree with a stack, front to back, one ray per invocation. Included by trace_closest.comp
// and trace_any.comp, which declare `result` and define ANY_HIT as 0 or 1.
#include "accel/count.glsl"
#include "shared/accel_records.h"
#include "shared/geometry_records.h"

layout(constant_id = 0) const bool resume = false;  // go on with suspended rays

layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { vec4 triangles[]; };
layout(set = 0, binding = 2) readonly buffer Rays { vec4 rays[]; };
layout(set = 0, binding = 3) readonly buffer Active { uint active_rays[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) buffer Suspended { uint suspended[]; };
layout(set = 0, binding = 6) buffer Unfinished { uint unfinished[]; };
layout(push_constant) uniform Push { TraceParams params; };

struct Ray {
    vec3 origin;
    vec3 inverse;       // of the direction
    vec3 shear_x;       // see hit_triangle
    vec3 shear_y;
    vec3 scale_z;
};

// Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection": the largest component of the direction becomes z,
// along which the ray is sheared. Rows of the shear instead of permuted indices: what they add is zeros, exactly.
Ray make_ray(vec3 origin, vec3 direction) {
    Ray ray;
    ray.origin = origin;
    // A zero's inverse is large, not infinite, lest it be multiplied with a zero.
    vec3 safe = mix(direction, vec3(1e-30), lessThan(abs(direction), vec3(1e-30)));
    ray.inverse = 1.0 / safe;
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) {
        ray.shear_x = vec3(-direction.y / direction.x, 1.0, 0.0);
        ray.shear_y = vec3(-direction.z / direction.x, 0.0, 1.0);
        ray.scale_z = vec3(1.0 / direction.x, 0.0, 0.0);
    } else if (size.y >= size.z) {
        ray.shear_x = vec3(0.0, -direction.z / direction.y, 1.0);
        ray.shear_y = vec3(1.0, -direction.x / direction.y, 0.0);
        ray.scale_z = vec3(0.0, 1.0 / direction.y, 0.0);
    } else {
        ray.shear_x = vec3(1.0, 0.0, -direction.x / direction.z);
        ray.shear_y = vec3(0.0, 1.0, -direction.y / direction.z);
        ray.scale_z = vec3(0.0, 0.0, 1.0 / direction.z);
    }
    return ray;
}

float sheared(vec3 row, vec3 v) { return (row.x * v.x + row.y * v.y) + row.z * v.z; }

// Distance and weights of the second and third vertex; false if it is missed or edge-on.
bool hit_triangle(Ray ray, vec3 a, vec3 b, vec3 c, out vec3 t_u_v) {
    a -= ray.origin;
    b -= ray.origin;
    c -= ray.origin;
    vec2 p = vec2(sheared(ray.shear_x, a), sheared(ray.shear_y, a));
    vec2 q = vec2(sheared(ray.shear_x, b), sheared(ray.shear_y, b));
    vec2 r = vec2(sheared(ray.shear_x, c), sheared(ray.shear_y, c));
    // Products are rounded monotonically, so a difference never has the wrong sign, and zero counts as inside.
    float u = r.x * q.y - r.y * q.x;
    float v = p.x * r.y - p.y * r.x;
    float w = q.x * p.y - q.y * p.x;
    float determinant = u + v + w;
    float scaled = u * sheared(ray.scale_z, a) + v * sheared(ray.scale_z, b) + w * sheared(ray.scale_z, c);
    bool inside = (min(min(u, v), w) >= 0.0 || max(max(u, v), w) <= 0.0) && determinant != 0.0;
    t_u_v = vec3(scaled, v, w) / (inside ? determinant : 1.0);
    return inside;
}

// Whether the ray meets the box before t_max, and where it enters it. The far side is moved by the rounding errors of the
// slabs' distances (Ize 2013, "Robust BVH ray traversal").
bool hit_box(Ray ray, vec3 low, vec3 high, float t_max, out float enter) {
    vec3 a = (low - ray.origin) * ray.inverse;
    vec3 b = (high - ray.origin) * ray.inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b) * 1.0000004;
    enter = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(min(far.x, far.y), min(far.z, t_max));
    return enter <= leave;
}

void main() {
    // Invocations run in a few contiguous blocks on CPUs, one per core: give each core every other group.
    uint thread = THREAD_INDEX;
    uint slot = 0u;
    uint ray_index;
    uint node = params.root;
    uint stack[ray_stack_size];
    uint height = 0u;
    if (resume) {
        if (thread >= min(suspended[0], params.slot_count)) {
            return;
        }
        slot = suspended_head + thread * suspended_stride;
        ray_index = suspended[slot];
        node = suspended[slot + 1u];
        height = suspended[slot + 2u];
        if (node == lbvh_end) {
            return;
        }
        for (uint i = 0u; i < height; ++i) {
            stack[i] = suspended[slot + 3u + i];
        }
    } else {
        uint i = params.first + thread;
        if (i >= ELEMENT_COUNT) {
            return;
        }
        ray_index = active_rays[i];
    }
    vec4 origin = rays[2u * ray_index];
    vec3 direction = rays[2u * ray_index + 1u].xyz;
    Ray ray = make_ray(origin.xyz, direction);
    HitRecord hit = HitRecord(no_triangle, origin.w, 0.0, 0.0);
    if (resume) {
        load_result(ray_index, hit);
    }
    if (!(origin.w >= 0.0)) {
        node = lbvh_end;
    }

    uint steps = 0u;
    while (node != lbvh_end && steps < params.step_limit) {
        ++steps;
        bool pop = true;
        if ((node & 1u) == 0u) {
            uvec4 left_low = nodes[2u * node];
            uvec4 left_high = nodes[2u * node + 1u];
            uvec4 right_low = nodes[2u * node + 2u];
            uvec4 right_high = nodes[2u * node + 3u];
            float left_enter, right_enter;
            bool left = hit_box(ray, uintBitsToFloat(left_low.xyz), uintBitsToFloat(left_high.xyz), hit.t, left_enter);
            bool right = hit_box(ray, uintBitsToFloat(right_low.xyz), uintBitsToFloat(right_high.xyz), hit.t, right_enter);
            bool right_first = right && !(left && left_enter <= right_enter);
            if (left && right) {
                stack[height] = right_first ? left_low.w : left_high.w;
                ++height;
            }
            if (left || right) {
                node = right_first ? left_high.w : left_low.w;
                pop = false;
            }
        } else {
            uint leaf = node >> 1u;
            vec4 a = triangles[3u * leaf];
            vec3 b = triangles[3u * leaf + 1u].xyz;
            vec3 c = triangles[3u * leaf + 2u].xyz;
            vec3 t_u_v;
            if (hit_triangle(ray, a.xyz, b, c, t_u_v) && t_u_v.x >= 0.0 && t_u_v.x <= hit.t) {
                // Of triangles at one distance the first in the scene counts, whatever the order of traversal.
                uint triangle = floatBitsToUint(a.w);
                if (t_u_v.x < hit.t || triangle < hit.triangle) {
                    hit = HitRecord(triangle, t_u_v.x, t_u_v.y, t_u_v.z);
                }
                if (ANY_HIT != 0) {
                    height = 0u;
                }
            }
        }
        if (pop) {
            node = lbvh_end;
            if (height > 0u) {
                --height;
                node = stack[height];
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
            suspended[slot + 2u] = height;
            for (uint i = 0u; i < height; ++i) {
                suspended[slot + 3u + i] = stack[i];
            }
        }
    }
}
