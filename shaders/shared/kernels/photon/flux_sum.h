CONSTANT uint ledgers_per_thread = 64u;

// Adds a signed value to a 64-bit sum in two words. Integer sums do not depend on the order.
FN void add(uint index, uint value) {
    if (value == 0u) {
        return;
    }
    uint old = atomicAdd(sums[2u * index], value);
    uint sign_extension = (value & 0x80000000u) != 0u ? 0xffffffffu : 0u;
    atomicAdd(sums[2u * index + 1u], fixed_add(uvec2(old, 0u), uvec2(value, sign_extension)).y);
}

FN void main() {
    uint first = THREAD_INDEX * ledgers_per_thread;
    if (first >= params.count) {
        return;
    }
    uvec4 emitted = uvec4(0u);
    uvec4 absorbed = uvec4(0u);
    uvec4 escaped = uvec4(0u);
    uvec4 cut = uvec4(0u);
    uvec4 lost = uvec4(0u);
    for (uint i = first; i < min(first + ledgers_per_thread, params.count); ++i) {
        emitted += ledgers[i].emitted;
        absorbed += ledgers[i].absorbed;
        escaped += ledgers[i].escaped;
        cut += ledgers[i].cut;
        lost += ledgers[i].lost;
    }
    for (uint channel = 0u; channel < 3u; ++channel) {
        add(channel, emitted[channel]);
        add(3u + channel, absorbed[channel]);
        add(6u + channel, escaped[channel]);
        add(9u + channel, cut[channel]);
        add(12u + channel, lost[channel]);
    }
}
