#version 460
#define VALUES
#include "kernel.glsl"
#include "parallel/sort_scatter_group.glsl"
