#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/compensated.h"
#include "shared/maths.h"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 1) readonly buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 2) buffer Film { FilmRecord film[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

#include "shared/kernels/methods/film_add.h"
