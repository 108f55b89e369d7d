#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer AreaPlaces { uint area_places[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) buffer Footprints { uvec4 footprints[]; };
layout(push_constant) uniform Push { FootprintParams params; };

#include "shared/kernels/photon/area_footprints.h"
