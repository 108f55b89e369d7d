#version 460
#extension GL_KHR_shader_subgroup_arithmetic : require
#define SUBGROUPS
#define VALUES
#define KEYS64
#include "kernel.glsl"
#include "parallel/sort_scatter_group.glsl"
