// Writes a piece's area, in the order of the space-filling curve, in fixed point: units so small
// that the sum of all pieces takes 63 bits.
FN void main() {
    uint k = THREAD_INDEX;
    if (k > params.count) {
        return;
    }
    if (k == params.count) {
        lows[k] = 0u; // where the sum of all others will be
        highs[k] = 0u;
        return;
    }
    uvec2 piece = pieces[order[k]];
    vec2 area = areas[piece.x];
    int scale = area_scale(area_state[area_state_largest], params.headroom_bits) -
                2 * int(divisions_of(piece.y));
    uvec2 rest = fixed_from_float(abs(area.y), scale);
    uvec2 units = fixed_from_float(area.x, scale);
    units = area.y < real(0.0) ? fixed_subtract(units, rest) : fixed_add(units, rest);
    lows[k] = units.x;
    highs[k] = units.y;
}
