#version 460
layout(local_size_x = 32) in;
#include "kernel.glsl"
#define TEXELS 0
#include "photon/nearest_gather.glsl"
