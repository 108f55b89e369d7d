#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 5) writeonly buffer Shares { uint shares[]; };
//@ unordered(area_places, 0, 1)
layout(set = 0, binding = 6) writeonly buffer AreaPlaces { uint area_places[]; };
//@ unordered(wide_caustics, 0, 1)
layout(set = 0, binding = 7) writeonly buffer WideCaustics { uint wide_caustics[]; };
layout(push_constant) uniform Push { FootprintParams params; };

#include "shared/kernels/photon/photon_footprints.h"
