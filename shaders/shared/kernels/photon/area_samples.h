#include "shared/kernels/alpha.h"
#include "shared/kernels/scene.h"

// Distributes points evenly over the surfaces that store photons: one at every step along the
// pieces' summed areas, and within a piece by a sequence of its own.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || counters[counter_stored_slots] + i >= params.capacity) {
        return;
    }
    uint target = i * params.step + params.offset;
    // The last piece that starts at or before the target.
    uint low = 0u;
    uint high = params.piece_count;
    while (high - low > 1u) {
        uint middle = low + (high - low) / 2u;
        if (area_sums[middle].before <= target) {
            low = middle;
        } else {
            high = middle;
        }
    }
    // The piece's first sample is the first target at or behind its start.
    uint begin = max(area_sums[low].before, params.offset) - params.offset;
    uint first = begin / params.step + (begin % params.step > 0u ? 1u : 0u);
    vec4 u = sobol_random4(params.seed, low, i - first, 0x80000000u);
    vec2 in_piece = sample_triangle(vec2(u));
    TrianglePiece piece = triangle_piece(area_sums[low].piece);
    vec2 b = piece.a + (piece.b - piece.a) * in_piece.x + (piece.c - piece.a) * in_piece.y;
    uvec4 t = triangles[area_sums[low].triangle];
    vec3 error;
    vec3 p = hit_point(vec3(positions[t.x]), vec3(positions[t.y]), vec3(positions[t.z]), b.x, b.y,
                       error);
    vec3 normal = normalize_or(cross3(vec3(positions[t.y]) - vec3(positions[t.x]),
                                      vec3(positions[t.z]) - vec3(positions[t.x])),
                               vec3(real(0.0), real(0.0), real(1.0)));
    // No photon lies where the surface is absent.
    bool absent = has_alpha && is_absent(t, coverage_at(t, b));
    real area = absent ? real(0.0) : real(params.area);
    // The area open to light on the front and on the back, of which other kernels take what is
    // covered, and the whole area.
    photons[counters[counter_stored_slots] + i] =
        PhotonRecord(p.x, p.y, p.z, pack_photon_normal(normal, false) | area_sample_bit, area, area,
                     area, area_sums[low].triangle);
}
