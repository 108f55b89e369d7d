// Which elements are whose; for kernels with a buffer `counts` and PartsRecord and CountRecord among their params.
#include "shared/parallel_records.h"

uint element_count() {
    return params.count.on_device != 0u ? min(counts[params.count.index], params.count.number) : params.count.number;
}

// First and one past the last element of a part.
uvec2 part_range(uint part, uint count) {
    uint size = part_size(count, params.parts);
    uint begin = part < count / size + 1u ? min(part * size, count) : count;    // part * size may overflow
    return uvec2(begin, min(size, count - begin) + begin);
}
