#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "transport_case.h"

layout(set = 0, binding = 0) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 1) readonly buffer Lights { LightRecord lights[]; };
layout(set = 0, binding = 2) readonly buffer Cameras { CameraRecord cameras[]; };
layout(set = 0, binding = 3) writeonly buffer Results { TransportResult results[]; };

void main() {
    uint i = THREAD_INDEX;
    if (i >= uint(results.length())) {
        return;
    }
    results[i] = transport_case(materials[i], lights[i], cameras[i & 1u], i);
}
