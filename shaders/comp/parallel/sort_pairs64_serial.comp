#version 460
#define VALUES
#define KEYS64
#include "kernel.glsl"
#include "parallel/sort_scatter_serial.glsl"
