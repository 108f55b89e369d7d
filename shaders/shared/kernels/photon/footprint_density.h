// Density estimation over the footprints that contain a query point: Fabianowski and Dingliana
// 2009, eq. 1 and section 6.3.

// Footprints have their own sizes; this is common to all of them.
struct Bandwidth {
    real flatness;
};

FN Bandwidth make_bandwidth() {
    Bandwidth b;
    b.flatness = params.flatness;
    return b;
}

// Boxes enclose whole footprints, so look for boxes that contain the point.
FN real search_radius2(IN(Bandwidth)) { return real(0.0); }

// Footprints reach as far as their ellipse does, which is known once they are read.
FN bool may_reach(IN(Bandwidth), vec3) { return true; }

FN void add_photon(IN(Bandwidth) b, uint j, INOUT(Query) q, INOUT(LeafSums) leaf) {
    uvec4 place = PHOTONS(2u * j);
    vec3 offset = q.p - bits_float(uvec3(place));
    FootprintDuals duals = unpack_duals(FOOTPRINTS(j));
    real x = dot3(duals.a, offset);
    real y = dot3(duals.b, offset);
    if (!(x * x + y * y > real(1.0)) && on_same_surface(q, place.w, offset)) {
        vec3 normal = unpack_photon_normal(place.w);
        real weight = footprint_weight(duals, normal, q.normal, offset, b.flatness, uniform_kernel);
        if (weight > real(0.0)) {
            uvec4 carried = PHOTONS(2u * j + 1u);
            if ((place.w & area_sample_bit) != 0u) {
                real area = open_area(q, carried) * weight;
                q.coverage += area;
                add_area(leaf.moments, area, -offset);
            } else if (is_caustic(place)) {
                leaf.caustic += scattered(q, carried).radiance * weight;
            } else {
                Scattered light = scattered(q, carried);
                vec3 flux = light.radiance * weight;
                leaf.indirect += flux;
                add_flux(leaf.moments, flux, light.weight, -offset, dot3(offset, offset));
            }
        }
    }
}

FN void add_leaf(IN(Bandwidth), IN(LeafSums) leaf, INOUT(Query) q) {
    add(q.indirect, leaf.indirect);
    if (caustics) {
        add(q.caustic, leaf.caustic);
    }
    add_moments(q.moments, leaf.moments, real(1.0));
}

// Area samples have the footprints of the diffusely scattered photons around them, and tell nothing
// of caustic ones.
FN real caustic_scale(IN(Bandwidth), real) { return real(1.0); }
