#version 460
#extension GL_KHR_shader_subgroup_arithmetic : require
#define SUBGROUPS
#include "kernel.glsl"
#include "parallel/compact_parts.glsl"
