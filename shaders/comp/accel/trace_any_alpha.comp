#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#define TEXELS 0
#include "accel/trace_any_alpha.glsl"
