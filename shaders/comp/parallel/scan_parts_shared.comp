#version 460
#include "kernel.glsl"
#include "parallel/scan_parts.glsl"
