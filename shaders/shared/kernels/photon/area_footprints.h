// An area sample derives the size of its footprint from the photons around it. It looks at so many
// places on either side of it in the map's order: the nearest 16 one after another, farther ones an
// eighth of their distance apart. The last is 1,500 records away.
CONSTANT uint area_steps = 56u;
CONSTANT uint area_steps_by_distance = 8u;
CONSTANT uint enough_sizes = 4u;        // for a mean by which others are chosen
CONSTANT uint enough_other_sizes = 16u; // where a sample's own surface has none

// Sums over the photons around an area sample, of its own surface and of any.
struct NearbySizes {
    real radius, weight;
    uint found;
    real radius_of_any;
    uint found_of_any;
};

// Adds photon j, if it belongs to the sample's surface and lies within a circle of half the area of
// the mean footprint so far. While few are found, the photon's own footprint may serve instead.
// Photons on both sides of the surface count. weight: number of records for which this one stands.
FN void add_size(uint j, real weight, vec3 position, vec3 normal, INOUT(NearbySizes) s) {
    uint packed = photons[j].normal;
    if ((packed & (area_sample_bit | photon_caustic_bit)) != 0u) {
        return;
    }
    real radius = mean_radius(unpack_duals(footprints[j]));
    if (s.found_of_any < enough_other_sizes) {
        s.radius_of_any += radius;
        ++s.found_of_any;
    }
    vec3 chord = vec3(photons[j].x, photons[j].y, photons[j].z) - position;
    real length2 = dot3(chord, chord);
    real mean = s.found > 0u ? s.radius / s.weight : real(0.0);
    real reach = s.found < enough_sizes ? max(mean, radius) : mean;
    if (length2 <= real(0.5) * sqr(reach) && sqr(dot3(chord, normal)) <= steepest_chord * length2 &&
        abs(dot3(unpack_photon_normal(packed), normal)) >= same_surface_cosine) {
        s.radius += weight * radius;
        s.weight += weight;
        ++s.found;
    }
}

// Mean radius of the photons nearby. Where photons spread as far as their neighbours do, part of
// them falls off the surface's edge; area samples with the same radius miss the same share. The
// mean is taken over as much of the surface as half of a footprint covers. If it followed each
// change of the sizes, the samples' sum would, too, and dividing an estimate by it would take light
// from where footprints are small, or add some.
FN real radius_nearby(uint i) {
    vec3 position = vec3(photons[i].x, photons[i].y, photons[i].z);
    vec3 normal = unpack_photon_normal(photons[i].normal);
    NearbySizes s;
    s.radius = s.weight = s.radius_of_any = real(0.0);
    s.found = s.found_of_any = 0u;
    uint after = counters[counter_stored] - i;
    uint offset = 1u;
    for (uint k = 0u; k < area_steps; ++k) {
        uint stride = max(offset / area_steps_by_distance, 1u);
        if (offset <= i) {
            add_size(i - offset, real(stride), position, normal, s);
        }
        if (offset < after) {
            add_size(i + offset, real(stride), position, normal, s);
        }
        offset += stride;
    }
    if (s.found > 0u) {
        return s.radius / s.weight;
    }
    // Without photons nearby, no photon is missing.
    return s.found_of_any > 0u ? s.radius_of_any / real(s.found_of_any) : params.scale.radius_max;
}

// Computes the footprints of area samples, in the order of the map.
FN void main() {
    uint k = THREAD_INDEX;
    if (k >= counters[counter_area_places]) {
        return;
    }
    uint i = area_places[k];
    vec3 normal = unpack_photon_normal(photons[i].normal);
    Frame frame = make_frame(normal);
    real radius = max(radius_nearby(i), params.least_area_radius);
    FootprintDuals duals =
        footprint_duals(Footprint(frame.x * radius, frame.y * radius, normal * radius), normal);
    footprints[i] = uvec4(pack_dual(duals.a), pack_dual(duals.b));
}
