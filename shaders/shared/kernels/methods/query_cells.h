// A cell in which queries share an estimate.
struct Cell {
    uvec4 place;
    uvec3 lobes; // material, direction and shading normal, where the estimate depends on them
};

FN bool same_cell(Cell a, Cell b) { return a.place == b.place && a.lobes == b.lobes; }

FN Cell cell_of(uint slot) {
    QueryRecord q = queries[slot];
    vec3 p = vec3(q.x, q.y, q.z);
    vec3 from_eye = p - vec3(params.eye_x, params.eye_y, params.eye_z);
    real pixel = params.pixel + params.pixel_slope * sqrt(dot3(from_eye, from_eye));
    Cell cell = Cell(query_cell(p, unpack_unit(q.geometric_normal), params.cell, pixel), uvec3(0u));
    cell.place.w |= ((q.flags >> query_scatterings_shift) & query_scatterings_mask) << 16;
    uint steps = (q.flags >> query_steps_shift) & query_steps_mask;
    if (steps > 0u) {
        QueryBsdfRecord bsdf = query_bsdfs[slot];
        uvec4 random = pcg4d(uvec4(float_bits(p), 0x85ebca6bu));
        bool flat_shaded = bsdf.shading_normal == q.geometric_normal;
        cell.lobes = uvec3(
            q.material + 1u, direction_cell(unpack_unit(bsdf.direction), steps, random.x),
            flat_shaded ? 0u : direction_cell(unpack_unit(bsdf.shading_normal), steps, random.y));
    }
    return cell;
}

// Finds each query's entry in a hash table of cells. The owner of a cell is the least of its
// shuffled slots, which does not depend on scheduling. The table has more entries than there are
// slots.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    uint source = no_query;
    if ((query_kinds[slot] & query_kind_mask) == params.query_kind) {
        if (params.cell > real(0.0)) {
            Cell cell = cell_of(slot);
            uint entry = pcg4d(cell.place ^ uvec4(cell.lobes, cell.lobes.x)).x & params.mask;
            for (;;) {
                uint other = atomicCompSwap(table[entry], no_query, slot);
                if (other == no_query || other == slot || same_cell(cell_of(other), cell)) {
                    break;
                }
                entry = (entry + 1u) & params.mask;
            }
            atomicMin(owners[entry], shuffled_slot(slot));
            source = entry;
        }
    }
    sources[slot] = source;
}
