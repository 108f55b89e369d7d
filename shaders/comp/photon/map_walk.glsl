// The photon map. It is read as texels if TEXELS is 1, through storage buffers if it is 0.
#include "shared/accel_records.h"
#include "shared/photon.h"

#if TEXELS
layout(set = 0, binding = 0) uniform utextureBuffer nodes;
layout(set = 0, binding = 1) uniform utextureBuffer photons;
#define NODES(i) texelFetch(nodes, int(i))
#define PHOTONS(i) texelFetch(photons, int(i))
#else
layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer Photons { uvec4 photons[]; };
#define NODES(i) nodes[i]
#define PHOTONS(i) photons[i]
#endif
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
