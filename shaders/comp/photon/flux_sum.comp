#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/fixed_point.h"
#include "shared/photon_records.h"

layout(set = 0, binding = 0) readonly buffer Ledgers { FluxLedger ledgers[]; };
layout(set = 0, binding = 1) buffer Sums { uint sums[]; };
layout(push_constant) uniform Push { FluxSumParams params; };

#include "shared/kernels/photon/flux_sum.h"
