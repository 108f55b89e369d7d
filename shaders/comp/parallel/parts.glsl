// Divides elements into parts. For kernels with a buffer `counts`, and with a PartsRecord `parts`
// and a CountRecord `count` among their params.
#include "shared/parallel_records.h"

uint element_count() {
    return params.count.on_device != 0u ? min(counts[params.count.index], params.count.number)
                                        : params.count.number;
}

// The first `count` of four elements, and `rest` instead of the others.
uvec4 first_of(uvec4 four, uint count, uint rest) {
    return mix(uvec4(rest), four, lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(count)));
}

// The range of a part's elements: the first, and the one behind the last.
uvec2 part_range(uint part, uint count) {
    uint size = part_size(count, params.parts);
    // part * size may overflow
    uint begin = part < count / size + 1u ? min(part * size, count) : count;
    return uvec2(begin, min(size, count - begin) + begin);
}
