#version 460
#include "kernel.glsl"
#include "parallel/compact_parts.glsl"
