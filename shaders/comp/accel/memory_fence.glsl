// Off on lavapipe, where atomics are sequentially consistent anyway. Version 22.3 handles a memory
// barrier as a control barrier, and loses its place in a loop that invocations run unequally often.
layout(constant_id = 0) const bool fences = true;

#define MEMORY_FENCE() \
    if (fences) {      \
        memoryBarrierBuffer(); \
    }
