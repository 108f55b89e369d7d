// Finds where a ray meets the surfaces that a cube map shows (Yao et al. 2010, section 5.1, after
// Szirmay-Kalos et al. 2005). The kernel declares
//   real map_distance(uint map, vec3 direction)
// the distance from the map's center to the surface in a direction of any length; far_away: none.

// A ray relative to a map's center. Both lie in one plane with all surface points that the search
// looks at. Its coordinates are along the ray and across it: the center is (0, 0), and points of
// the ray are (x, height) for x >= start.
struct PlaneRay {
    vec3 along, across; // unit vectors
    real start, height;
};

// origin: relative to the center; direction: a unit vector.
FN PlaneRay plane_ray(vec3 origin, vec3 direction) {
    PlaneRay ray;
    ray.along = direction;
    ray.start = dot3(origin, direction);
    ray.across = unit_and_length(origin - direction * ray.start, ray.height);
    if (!(ray.height > real(0.0))) { // through the center: any plane
        ray.across = make_frame(direction).x;
    }
    return ray;
}

FN vec3 in_space(IN(PlaneRay) ray, vec2 place) {
    return ray.along * place.x + ray.across * place.y;
}

// A direction from the center, and the surface there.
struct Look {
    vec2 direction; // a unit vector
    real distance;  // of the surface; far_away: there is none
};

FN Look look(IN(PlaneRay) ray, uint map, vec2 direction) {
    Look seen;
    seen.direction = unit_direction(direction);
    seen.distance = map_distance(map, in_space(ray, seen.direction));
    return seen;
}

FN bool sees_surface(Look seen) { return seen.distance < far_away; }

// Whether the surface hides the ray's point in this direction: the point overshoots.
FN bool is_hidden(IN(PlaneRay) ray, Look seen) {
    return sees_surface(seen) &&
           (seen.direction.y > real(0.0) ? seen.distance * seen.direction.y < ray.height
                                         : seen.direction.x > real(0.0));
}

// Where the line through two surface points crosses the ray. Not finite if it does not.
FN real secant(IN(PlaneRay) ray, Look a, Look b) {
    vec2 p = a.direction * a.distance;
    vec2 q = b.direction * b.distance;
    return p.x + (ray.height - p.y) * ((q.x - p.x) / (q.y - p.y));
}

// False position between a direction in which the ray's point is seen, and one in which it is
// hidden. Where the secant leaves the bracket or there is none, or twice the same end stays, the
// bracket is halved. Returns the look that shows the surface nearest to the ray.
FN Look refine(IN(PlaneRay) ray, uint map, Look seen, Look hidden, uint steps) {
    Look nearest = hidden;
    real least = far_away;
    uint kept = 0u; // how often in a row the same end stayed
    bool kept_seen = false;
    for (uint i = 0u; i < steps; ++i) {
        real x = secant(ray, seen, hidden);
        vec2 next = seen.direction + hidden.direction;
        bool inside = (x * seen.direction.y > ray.height * seen.direction.x) !=
                      (x * hidden.direction.y > ray.height * hidden.direction.x);
        if (sees_surface(seen) && is_finite(x) && inside && kept < 2u) {
            next = vec2(x, ray.height);
        }
        Look last = look(ray, map, next);
        real off = abs(last.distance * last.direction.y - ray.height);
        if (off < least) {
            nearest = last;
            least = off;
        }
        bool over = is_hidden(ray, last);
        kept = over == kept_seen ? kept + 1u : 1u;
        kept_seen = over;
        if (over) {
            hidden = last;
        } else {
            seen = last;
        }
    }
    return nearest;
}

// The iteration as published. The first guess is the surface in the ray's direction, `ahead`; then
// follow the plane through it across the ray, and secants through the last two surface points, or
// between the last ones in front of the ray and behind it once there are both. Returns the last
// look.
FN Look iterate(IN(PlaneRay) ray, uint map, Look ahead, uint steps) {
    Look hidden = ahead;
    Look seen = ahead;
    bool brackets = false;
    Look last = ahead;
    real x = ahead.distance;
    for (uint i = 0u; i < steps; ++i) {
        if (!is_finite(x)) {
            break;
        }
        x = max(x, ray.start);
        Look before = hidden;
        last = look(ray, map, vec2(x, ray.height));
        if (!sees_surface(last)) {
            break;
        }
        if (is_hidden(ray, last)) {
            hidden = last;
        } else {
            seen = last;
            brackets = true;
        }
        x = brackets ? secant(ray, seen, hidden) : secant(ray, before, last);
    }
    return last;
}
