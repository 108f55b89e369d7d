#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "material_features.glsl"
#include "shared/bsdf.h"
#include "shared/geometry_records.h"
#include "shared/photon.h"
#include "shared/photon_records.h"
#include "shared/texture_record.h"
#include "shared/view_points.h"

layout(set = 0, binding = 0) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 1) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 2) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 5) readonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 6) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 7) writeonly buffer Alive { uint alive[]; };
layout(set = 0, binding = 8) buffer Unlinked { uint unlinked_cells[]; };
layout(push_constant) uniform Push { ViewLinkParams params; };

#include "shared/kernels/photon/view_links.h"
