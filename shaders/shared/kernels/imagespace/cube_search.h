// Searches cube maps for the hits of rays. As published (Yao et al. 2010, section 5.2), each ray is
// searched for in each map, and the nearest hit counts: where a map does not show what a ray meets
// first, light leaks. Here the search ends where a map shows all that is near the ray's way.

FN vec3 center_of(uint map) { return vec3(centers[map / params.layers]); }

FN uvec2 map_texel(uint map, vec3 direction) {
    return map_texels[map * cube_texels(params.size) + cube_texel(direction, params.size)];
}

FN real map_distance(uint map, vec3 direction) { return bits_float(map_texel(map, direction).y); }

#include "shared/kernels/imagespace/root_finder.h"
#include "shared/kernels/imagespace/triangle_plane.h"
#include "shared/kernels/imagespace/weights_toward.h"

// Share by which the distance of a texel may differ from that of a place in it.
CONSTANT real depth_error = real(0.002);

// A ray on its way through the maps, and what they have shown of it.
struct Search {
    vec3 origin, direction;
    RayShear shear;
    uint from;        // the triangle that the ray leaves; no_triangle: unknown
    vec3 normal;      // of that triangle
    HitRecord passed; // hits up to this one do not count
    HitRecord hit;
    real enter, leave; // of the scene's box
    bool from_light;   // it starts on the triangle of a light
    bool is_seen;      // some map shows where
    bool escapes;
};

FN bool leaves_triangle(IN(Search) search) {
    return search.from != no_triangle && search.enter == real(0.0);
}

FN bool accept(HitRecord found, INOUT(Search) search) {
    if (!comes_before(search.passed, found)) {
        return false;
    }
    if (comes_before(found, search.hit)) {
        search.hit = found;
    }
    return true;
}

// A direction from the middle of a texel to that of one of the eight around it, or of itself.
FN vec3 around(vec3 direction, uint which) {
    uint row = which / 3u;
    vec2 step = vec2(real(which % 3u) - real(1.0), real(row) - real(1.0));
    return cube_neighbour(direction, step, params.size);
}

FN bool intersect(vec3 origin, IN(RayShear) shear, uint triangle, OUT(HitRecord) found) {
    uvec4 t = triangles[triangle];
    real distance, u, v;
    bool met = intersect_triangle(shear, origin, vec3(positions[t.x]), vec3(positions[t.y]),
                                  vec3(positions[t.z]), real(0.0), far_away, distance, u, v);
    found = HitRecord(triangle, distance, u, v);
    return met;
}

// Whether the map shows a triangle at a place of it, relative to the center. The texel there may
// show its own middle only: then one of those around it shows the triangle, and what the texel
// shows does not hide the place.
FN bool shows(uint map, vec3 place, uint triangle) {
    uint middle = map_texel(map, place).x;
    bool found = middle == triangle;
    for (uint i = 0u; i < 9u && !found; ++i) {
        found = map_texel(map, around(place, i)).x == triangle;
    }
    HitRecord hit;
    return found && (middle == triangle || middle == no_triangle ||
                     !intersect(center_of(map), ray_shear(place), middle, hit) ||
                     hit.t >= real(1.0) - depth_error);
}

// Whether the ray meets a triangle where the map shows it. A large one may be met elsewhere, behind
// something.
FN bool meet(uint map, uint triangle, INOUT(Search) search) {
    HitRecord found;
    if (triangle == no_triangle || !intersect(search.origin, search.shear, triangle, found)) {
        return false;
    }
    vec3 place = search.origin + search.direction * found.t - center_of(map);
    return shows(map, place, triangle) && accept(found, search);
}

// Whether the ray meets the triangle of the texel in a direction, or else of one of those around
// it.
FN bool meet_around(uint map, vec3 direction, INOUT(Search) search) {
    uint middle = map_texel(map, direction).x;
    if (meet(map, middle, search)) {
        return true;
    }
    bool met = false;
    uint last = middle;
    for (uint i = 0u; i < 9u; ++i) {
        uint triangle = map_texel(map, around(direction, i)).x;
        if (triangle != middle && triangle != last) {
            met = meet(map, triangle, search) || met;
        }
        last = triangle;
    }
    return met;
}

// The hit at a surface point of the map, if it lies as good as on the ray: e of equation 2 is at
// most the tolerance. Nearer than the width of a texel it is the surface that the ray leaves.
FN bool meet_point(IN(PlaneRay) ray, uint map, Look at, INOUT(Search) search) {
    vec2 place = at.direction * at.distance - vec2(ray.start, ray.height);
    real distance = sqrt(place.x * place.x + place.y * place.y);
    bool is_near = real(1.0) - place.x / distance <= real(params.tolerance);
    if (!is_near || distance * real(params.size) < real(2.0) * at.distance) {
        return false;
    }
    vec3 direction = in_space(ray, at.direction);
    HitRecord found;
    found.triangle = map_texel(map, direction).x;
    found.t = distance;
    uvec4 t = triangles[found.triangle];
    vec3 center = center_of(map);
    vec2 weights = weights_toward(direction, vec3(positions[t.x]) - center,
                                  vec3(positions[t.y]) - center, vec3(positions[t.z]) - center);
    found.u = weights.x;
    found.v = weights.y;
    return accept(found, search);
}

FN bool meet_at(IN(PlaneRay) ray, uint map, Look at, INOUT(Search) search) {
    if (params.exact != 0u) {
        return meet_around(map, in_space(ray, at.direction), search);
    }
    return sees_surface(at) && meet_point(ray, map, at, search);
}

// The iteration as published, from the surface in the ray's direction, in all maps. A ray from a
// center needs one lookup in its map.
FN void search_as_published(INOUT(Search) search) {
    for (uint map = 0u; map < params.centers * params.layers; ++map) {
        PlaneRay ray = plane_ray(search.origin - center_of(map), search.direction);
        Look ahead = look(ray, map, vec2(real(1.0), real(0.0)));
        if (!sees_surface(ahead)) { // "a point at infinity" (type A)
            search.escapes = search.escapes || map % params.layers == layer_opaque;
        } else if (ray.start == real(0.0) && ray.height == real(0.0)) {
            meet_at(ray, map, ahead, search);
        } else {
            meet_at(ray, map, iterate(ray, map, ahead, params.steps), search);
        }
    }
}

// The ray's start, or the point where it enters the scene, as a map shows it.
struct Start {
    Look look;
    bool hidden;
    bool shown; // the map shows the triangle that the ray leaves
};

// On the triangle that the ray leaves, the start is hidden where the ray leaves on the side that
// faces away from the center.
FN Start look_at_start(IN(PlaneRay) ray, uint map, IN(Search) search) {
    vec2 place = vec2(ray.start + search.enter, ray.height);
    real reach = sqrt(place.x * place.x + place.y * place.y);
    Start start;
    start.look = look(ray, map, place);
    real distance = start.look.distance;
    start.hidden = distance < (real(1.0) - depth_error) * reach;
    start.shown = false;
    if (leaves_triangle(search)) {
        vec3 in_map = in_space(ray, place);
        start.shown =
            abs(distance - reach) <= depth_error * reach || shows(map, in_map, search.from);
        bool away = dot3(search.normal, in_map) * dot3(search.normal, search.direction) > real(0.0);
        start.hidden = start.shown ? away : start.hidden;
    }
    start.look.distance = start.hidden ? min(distance, reach) : max(distance, reach);
    return start;
}

// Looks at the ray's points within the scene and up to a hit that was found before, in directions
// that turn evenly, and searches where a surface begins to hide them, or ends to: from behind a
// wall, the ray comes through it. Where it only passes the edge of something, nothing is met.
// Returns whether the map shows all of the ray's way to its hit, or that there is none.
// start_shown: some map around the center shows where the ray starts.
FN bool march(IN(PlaneRay) ray, uint map, Start start, bool start_shown, INOUT(Search) search) {
    vec2 from = unit_direction(vec2(ray.start + search.enter, ray.height));
    real end = min(search.leave, search.hit.t); // nothing behind a hit counts
    vec2 to = unit_direction(vec2(ray.start + end, ray.height));
    vec2 middle = unit_direction(from + to);
    middle = middle.y > real(0.0) ? middle : vec2(real(0.0), real(1.0));
    // Of the angle by which the ray turns around the center. Rays that turn less cross fewer texels
    // and need fewer looks. In proportion to the angle there would be too few: what is seen at a
    // small angle is far away, and small.
    real sine_of_half =
        sqrt(max(real(0.5) * (real(1.0) - from.x * to.x - from.y * to.y), real(0.0)));
    uint looks = max(uint(ceil(real(params.march) * sqrt(sine_of_half))), 1u);
    Look before = start.look;
    bool hidden = start.hidden;
    bool clear = start_shown && !hidden;
    search.is_seen = search.is_seen || (clear && (start.shown || !leaves_triangle(search)));
    for (uint i = 1u; i <= looks; ++i) {
        real turned = real(2u * i) / real(looks);
        vec2 direction =
            turned < real(1.0) ? mix(from, middle, turned) : mix(middle, to, turned - real(1.0));
        Look next = look(ray, map, i == looks ? to : direction);
        bool was_hidden = hidden;
        hidden = is_hidden(ray, next);
        if (hidden != was_hidden) {
            Look seen = before;
            Look beyond = next;
            if (was_hidden) {
                seen = next;
                beyond = before;
            }
            if (meet_at(ray, map, refine(ray, map, seen, beyond, params.steps), search)) {
                return clear;
            }
        }
        clear = clear && !hidden;
        before = next;
    }
    // A wall on the edge of the scene may not hide what lies behind it.
    if (!hidden && meet_at(ray, map, before, search)) {
        return clear;
    }
    search.escapes = search.escapes || (clear && map % params.layers == layer_opaque);
    return clear;
}

// A ray from the center needs one look. Returns as march() does.
FN bool look_from_center(IN(PlaneRay) ray, uint map, INOUT(Search) search) {
    Look ahead = look(ray, map, vec2(real(1.0), real(0.0)));
    if (meet_at(ray, map, ahead, search)) {
        return true;
    }
    bool clear = !sees_surface(ahead);
    search.escapes = search.escapes || (clear && map % params.layers == layer_opaque);
    return clear;
}

// Searches the maps around a center. Returns whether no others can show anything nearer.
FN bool search_around(uint center, INOUT(Search) search) {
    PlaneRay ray = plane_ray(search.origin - vec3(centers[center]), search.direction);
    uint first = center * params.layers;
    bool done = true;
    if (ray.start == real(0.0) && ray.height == real(0.0)) {
        search.is_seen = true;
        for (uint layer = 0u; layer < params.layers; ++layer) {
            done = look_from_center(ray, first + layer, search) && done;
        }
        return done;
    }
    // The triangle that the ray leaves is in one layer, if it is not too small to be in any.
    Start starts[most_layers];
    bool shown = !leaves_triangle(search);
    for (uint layer = 0u; layer < params.layers; ++layer) {
        starts[layer] = look_at_start(ray, first + layer, search);
        shown = shown || starts[layer].shown;
    }
    for (uint layer = 0u; layer < params.layers; ++layer) {
        done = march(ray, first + layer, starts[layer], shown, search) && done;
    }
    return done;
}

FN uint nearest_center(vec3 place) {
    uint nearest = 0u;
    real least = far_away;
    for (uint center = 0u; center < params.centers; ++center) {
        vec3 way = place - vec3(centers[center]);
        real distance = dot3(way, way);
        nearest = distance < least ? center : nearest;
        least = min(least, distance);
    }
    return nearest;
}

// Searches around the nearest center first, which shows the most detail. Photons that start on a
// lamp where no map shows it are lost: half of them may be within a closed bulb.
FN void search_all(INOUT(Search) search) {
    uint nearest = nearest_center(search.origin + search.direction * search.enter);
    bool done = false;
    for (uint k = 0u; k < params.centers && !done; ++k) {
        done = search_around(k == 0u ? nearest : (k <= nearest ? k - 1u : k), search);
    }
    if (search.from_light && !search.is_seen) {
        search.hit = HitRecord(no_triangle, far_away, ray_lost, real(0.0));
    }
}

// The triangle of the last hit if the ray starts there.
FN uint triangle_left(HitRecord last, vec3 origin) {
    if (last.t == start_of_path || last.triangle >= params.triangles) {
        return last.triangle < params.triangles ? last.triangle : no_triangle;
    }
    uvec4 t = triangles[last.triangle];
    vec3 error;
    vec3 a = vec3(positions[t.x]);
    vec3 b = vec3(positions[t.y]);
    vec3 c = vec3(positions[t.z]);
    vec3 place = hit_point(a, b, c, last.u, last.v, error);
    return max_component(abs(place - origin) - real(4.0) * error) <= real(0.0) ? last.triangle
                                                                               : no_triangle;
}

FN void begin(uint index, INOUT(Search) search) {
    RayRecord r = rays[index];
    search.origin = vec3(r.origin_x, r.origin_y, r.origin_z);
    search.direction = vec3(r.direction_x, r.direction_y, r.direction_z);
    search.shear = ray_shear(search.direction);
    search.hit = HitRecord(no_triangle, r.t_max, ray_lost, real(0.0));
    search.passed = HitRecord(0u, -real(1.0), real(0.0), real(0.0));
    search.from = triangle_left(hits[index], search.origin);
    search.from_light = hits[index].t == start_of_path && search.from != no_triangle;
    search.is_seen = false;
    search.normal = vec3(real(0.0));
    if (search.from != no_triangle) {
        search.normal = triangle_plane(search.from).normal;
    }
    if (goes_on_behind_hit(r.t_max)) {
        search.passed = hits[index];
        search.hit.t = far_away;
    }
    vec3 to_low =
        (vec3(params.low_x, params.low_y, params.low_z) - search.origin) / search.direction;
    vec3 to_high =
        (vec3(params.high_x, params.high_y, params.high_z) - search.origin) / search.direction;
    vec3 leave = max(to_low, to_high);
    search.enter = max(max_component(min(to_low, to_high)), real(0.0));
    search.leave = min(leave.x, min(leave.y, leave.z));
    search.escapes = search.leave < search.enter;
}

FN void search_maps(INOUT(Search) search) {
    if (params.march > 0u) {
        search_all(search);
    } else {
        search_as_published(search);
    }
}
