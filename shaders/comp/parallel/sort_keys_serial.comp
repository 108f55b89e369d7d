#version 460
#include "kernel.glsl"
#include "parallel/sort_scatter_serial.glsl"
